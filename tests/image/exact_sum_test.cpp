#include "image/exact_sum.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "base/parallel.h"
#include "image/sample_adder.h"
#include "media/random_stream.h"

using namespace duet;

namespace {

/// Numbers of very different sizes and both signs.
std::vector<double> some_values(int count) {
  std::vector<double> values;
  RandomStream random(7);
  for (int i = 0; i < count; ++i)
    values.push_back(std::ldexp(double(random.next()) - 0.5, int(80 * random.next()) - 40));
  return values;
}

ExactSum sum_of(const std::vector<double>& values) {
  ExactSum sum;
  for (const double v : values) sum.add(v);
  return sum;
}

FilmLayout layout_with(FilterKind kind) {
  FilterDescription filter;
  filter.kind = kind;
  return {{40, 30}, {0, 0, 40, 30}, filter};
}

/// Samples anywhere in a tile, some of them large.
struct TileSample {
  Point2f position;
  std::array<float, 2> values;
};

std::vector<TileSample> samples_in(const FilmTile& tile, int count) {
  std::vector<TileSample> samples;
  RandomStream random(3);
  const PixelBounds& b = tile.sampled();
  for (int i = 0; i < count; ++i) {
    const float x = float(b.x0) + float(b.width()) * random.next(),
                y = float(b.y0) + float(b.height()) * random.next();
    const float v = random.next();
    samples.push_back({{x, y}, {v, i % 50 == 0 ? 1e6f * v : -v / 3}});
  }
  return samples;
}

void add(const Film& film, FilmTile& tile, std::span<const TileSample> samples) {
  SampleAdder sums(film, tile);
  for (const TileSample& s : samples)
    sums.add(int(s.position.x), int(s.position.y), s.position, s.values);
}

bool equal(std::span<const ExactSum> a, std::span<const ExactSum> b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end());
}

}  // namespace

TEST_CASE("an exact sum does not depend on the order or the grouping") {
  std::vector<double> values = some_values(10000);
  const ExactSum sum = sum_of(values);
  std::mt19937 random(1);
  for (int i = 0; i < 5; ++i) {
    std::shuffle(values.begin(), values.end(), random);
    const size_t cut = size_t(i) * 2000;
    ExactSum first = sum_of({values.begin(), values.begin() + ptrdiff_t(cut)});
    first.add(sum_of({values.begin() + ptrdiff_t(cut), values.end()}));
    CHECK(first == sum);
  }
  // Doubles added one by one do depend on it.
  double forwards = 0, backwards = 0;
  for (const double v : values) forwards += v;
  for (auto v = values.rbegin(); v != values.rend(); ++v) backwards += *v;
  CHECK(forwards != backwards);
}

TEST_CASE("an exact sum is the sum") {
  for (const double x : {0.0, 1.0, -1.0, 0.1, -0.1, 1e-9, -1e9, 0x1p30, -0x1p30, 0x1.fffffp29,
                         0x1p48, -0x1p48, 0x1p-64, -0x1p-64, 12345678901.25}) {
    CAPTURE(x);
    ExactSum sum;
    sum.add(x);
    // Half a unit at most is lost.
    CHECK(std::abs(sum.value() - x) <= std::max(0x1p-65, 0x1p-52 * std::abs(x)));
    sum.add(-x);
    CHECK(sum == ExactSum());
  }
  ExactSum sides;
  sides.add(1e9), sides.add(1e-9), sides.add(-1e9);
  CHECK(sides.value() == doctest::Approx(1e-9).epsilon(1e-9));
  const std::vector<double> values = some_values(10000);
  long double expected = 0;
  for (const double v : values) expected += static_cast<long double>(v);
  CHECK(sum_of(values).value() == doctest::Approx(double(expected)).epsilon(1e-14));
  CHECK(ExactSum(0, 1).value() == 1);
  CHECK(ExactSum(uint64_t(1) << 63, ~uint64_t(0)).value() == -0.5);
}

TEST_CASE("a tile has the same sums in whichever order and parts it gets its samples") {
  for (const FilterKind kind : {FilterKind::box, FilterKind::gaussian, FilterKind::lanczos}) {
    const Film film(layout_with(kind), {"a", "b"});
    FilmTile whole = film.tiles()[1], parts = whole, other = whole;
    std::vector<TileSample> samples = samples_in(whole, 5000);
    add(film, whole, samples);
    std::mt19937 random(2);
    std::shuffle(samples.begin(), samples.end(), random);
    add(film, parts, std::span(samples).first(700));
    add(film, other, std::span(samples).subspan(700));
    parts.add(other);
    CHECK(equal(whole.sums(), parts.sums()));
    other.clear();
    CHECK(std::all_of(other.sums().begin(), other.sums().end(),
                      [](const ExactSum& s) { return s == ExactSum(); }));
  }
}

TEST_CASE("colours and alpha have the sums that they have among other channels") {
  for (const FilterKind kind : {FilterKind::box, FilterKind::gaussian})
    for (const bool limited : {false, true}) {
      FilmLayout layout = layout_with(kind);
      if (limited) layout.sample_limit = SampleLimit{.most = 3};
      const Film film(layout, {"R", "G", "B", "A"}), wider(layout, {"R", "G", "B", "A", "more"});
      FilmTile tile = film.tiles()[1], wide = wider.tiles()[1];
      {
        SampleAdder sums(film, tile), wide_sums(wider, wide);
        for (const TileSample& s : samples_in(tile, 5000)) {
          // The second is at times very large: so is every channel in turn.
          std::array<float, 5> values{s.values[0], 0.3f * s.values[0], -s.values[0], 1, 0};
          const size_t channel = size_t(16 * s.position.y) % 4;
          values[channel] = s.values[1];
          const int x = int(s.position.x), y = int(s.position.y);
          sums.add(x, y, s.position, std::span(values).first<4>());
          wide_sums.add(x, y, s.position, values);
        }
      }
      size_t different = 0;
      for (size_t i = 0; i < tile.sums().size(); ++i)
        different += !(tile.sums()[i] == wide.sums()[i / 5 * 6 + i % 5]);
      CHECK(different == 0);
    }
}

TEST_CASE(
    "a constant is one after a million samples, and keeps what is small beside what is large") {
  for (const FilterKind kind : {FilterKind::box, FilterKind::gaussian}) {
    FilterDescription filter;
    filter.kind = kind;
    Film film({{2, 1}, {0, 0, 2, 1}, filter}, {"a", "b"});
    FilmTile& tile = film.tiles()[0];
    {
      SampleAdder sums(film, tile);
      RandomStream random(5);
      for (int i = 0; i < 1000000; ++i) {
        const Point2f p{2 * random.next(), random.next()};
        const bool is_bright = kind == FilterKind::box && p.x < 1;
        sums.add(int(p.x), 0, p, std::array{0.1f, is_bright ? 1e9f : 1e-9f});
      }
    }
    const Image image = film.develop();
    CHECK(image.pixel(0, 0)[0] == 0.1f);
    CHECK(image.pixel(1, 0)[0] == 0.1f);
    CHECK(image.pixel(1, 0)[1] == 1e-9f);
    if (kind == FilterKind::box) CHECK(image.pixel(0, 0)[1] == 1e9f);
  }
}

TEST_CASE("splats may come from many threads in any order") {
  for (const FilterKind kind : {FilterKind::box, FilterKind::gaussian}) {
    const auto film = [&] {
      Film f(layout_with(kind), {"R", "G", "B"});
      f.add_splat_layer(0);
      return f;
    };
    std::vector<Splat> splats;
    RandomStream random(9);
    for (int i = 0; i < 20000; ++i) {
      const Point2f p{42 * random.next() - 1, 32 * random.next() - 1};
      splats.push_back({p, Spectrum(random.next(), 100 * random.next(), 1e-6f)});
    }
    Film one = film(), many = film();
    one.add_splats(0, splats, 0.3f);
    parallel_for(64, 4, [&](size_t i) {
      // Every 64th, from another one on.
      std::vector<Splat> part;
      for (size_t k = 63 - i; k < splats.size(); k += 64) part.push_back(splats[k]);
      many.add_splats(0, part, 0.3f);
    });
    one.end_pass(), many.end_pass();
    CHECK(one.develop().data == many.develop().data);
    CHECK(one.develop().pixel(20, 20)[0] > 0);
  }
}

TEST_CASE("moments are those of passes, and leave the image as it is") {
  for (const FilterKind kind : {FilterKind::box, FilterKind::gaussian}) {
    Film film(layout_with(kind), {"R", "G", "B", "m.R", "m.G", "m.B"});
    Film plain(layout_with(kind), {"R", "G", "B", "m.R", "m.G", "m.B"});
    for (Film* f : {&film, &plain}) f->add_splat_layer(0);
    film.add_moments(3);
    for (const float light : {1.0f, 4.0f, 7.0f}) {
      for (Film* f : {&film, &plain}) {
        Film& pass = f->begin_pass();
        for (FilmTile& tile : pass.tiles()) {
          SampleAdder sums(pass, tile);
          const PixelBounds& b = tile.sampled();
          for (int y = b.y0; y < b.y1; ++y)
            for (int x = b.x0; x < b.x1; ++x) {
              const std::array<float, 6> values{light, light, light};
              sums.add(x, y, {float(x) + 0.5f, float(y) + 0.5f}, values);
            }
        }
        std::vector<Splat> splats;
        for (int i = 0; i < 40 * 30; ++i)
          splats.push_back({{float(i % 40) + 0.5f, float(i / 40) + 0.5f}, Spectrum(2.0f)});
        pass.add_splats(0, splats, 1);
        f->end_pass();
      }
    }
    const Image image = film.develop(), expected = plain.develop();
    for (int c = 0; c < 3; ++c) {
      CHECK(image.pixel(20, 15)[c] == expected.pixel(20, 15)[c]);
      // (1 + 2)², (4 + 2)² and (7 + 2)².
      if (kind == FilterKind::box) CHECK(image.pixel(20, 15)[3 + c] == doctest::Approx(42));
    }
  }
}
