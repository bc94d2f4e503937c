#include "image/sample_adder.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "math/sampler.h"

using namespace duet;

namespace {

constexpr std::array kKinds{FilterKind::box,      FilterKind::tent,       FilterKind::gaussian,
                            FilterKind::mitchell, FilterKind::catmullrom, FilterKind::lanczos};

FilterDescription describe(FilterKind kind) {
  FilterDescription d;
  d.kind = kind;
  if (kind == FilterKind::tent) d.radius = 1;
  return d;
}

/// Fills a tile with samples that depend on the pixel only, as a renderer does.
template <class Value>
void fill_tile(const Film& film, FilmTile& tile, int spp, const Value& value) {
  SampleAdder sums(film, tile);
  for (int y = tile.sampled().y0; y < tile.sampled().y1; ++y)
    for (int x = tile.sampled().x0; x < tile.sampled().x1; ++x) {
      Sampler sampler(SampleSequence::independent, 3, 0, uint64_t(y) * 1000 + uint64_t(x));
      for (int i = 0; i < spp; ++i) {
        sampler.start_sample(uint32_t(i));
        const Point2f u = sampler.next_2d();
        const Point2f p{float(x) + u.x, float(y) + u.y};
        const std::array<float, 2> v = value(p);
        sums.add(x, y, p, v);
      }
    }
}

template <class Value>
void fill(Film& film, int spp, const Value& value) {
  for (FilmTile& tile : film.tiles()) fill_tile(film, tile, spp, value);
}

std::array<float, 2> pattern(const Point2f& p) {
  return {std::sin(p.x * 0.7f) + 2, p.x * p.y * 0.01f};
}

}  // namespace

TEST_CASE("samples have a limit, by what a sensor makes of their colours") {
  // The sensor sees half of red and nothing of blue.
  const SampleLimit limit{{{{0.5, 0, 0}, {0, 1, 0}, {0, 0, 0}}}, 2};
  for (const FilterKind kind : {FilterKind::box, FilterKind::gaussian}) {
    FilmLayout layout{{1, 1}, {0, 0, 1, 1}, describe(kind)};
    layout.sample_limit = limit;
    Film film(layout, {"R", "G", "B", "A"});
    Film other(layout, {"X", "Y", "Z", "A"});
    for (Film* f : {&film, &other}) {
      SampleAdder sums(*f, f->tiles().front());
      for (const std::array<float, 4>& v : {std::array<float, 4>{8, 0, 6, 3}, {3, 1, 100, 5}})
        sums.add(0, 0, {0.5f, 0.5f}, v);
    }
    // The first is halved, the second is not.
    const Image image = film.develop();
    CHECK(image.data[0] == doctest::Approx(3.5));
    CHECK(image.data[1] == doctest::Approx(0.5));
    CHECK(image.data[2] == doctest::Approx(51.5));
    CHECK(image.data[3] == doctest::Approx(4));
    CHECK(other.develop().data[0] == doctest::Approx(5.5));
  }
}

TEST_CASE("a crop window has the very pixels of the full image") {
  const Point2i size{50, 37};
  for (const FilterKind kind : kKinds) {
    Film full({size, {0, 0, size.x, size.y}, describe(kind)}, {"a", "b"});
    fill(full, 3, pattern);
    const Image image = full.develop();
    for (const PixelBounds crop :
         {PixelBounds{10, 4, 41, 33}, PixelBounds{0, 0, 1, 1}, PixelBounds{49, 36, 50, 37},
          PixelBounds{15, 15, 18, 17}, PixelBounds{0, 16, 50, 32}}) {
      Film part({size, crop, describe(kind)}, {"a", "b"});
      fill(part, 3, pattern);
      const Image cut = part.develop();
      REQUIRE(cut.width == crop.width());
      REQUIRE(cut.height == crop.height());
      int different = 0;
      for (int y = 0; y < cut.height; ++y)
        for (int x = 0; x < cut.width; ++x)
          for (int c = 0; c < 2; ++c)
            different += cut.pixel(x, y)[c] != image.pixel(x + crop.x0, y + crop.y0)[c];
      INFO("filter " << int(kind) << " crop from " << crop.x0 << ", " << crop.y0);
      CHECK(different == 0);
    }
  }
}

TEST_CASE("where the image ends at the window nothing beyond counts") {
  const Point2i size{50, 37};
  const PixelBounds crop{10, 4, 41, 33};
  for (const FilterKind kind : kKinds) {
    Film cut_out({size, crop, describe(kind)}, {"a", "b"});
    Film window({size, crop, describe(kind), true}, {"a", "b"});
    for (Film* film : {&cut_out, &window}) fill(*film, 16, pattern);
    PixelBounds sampled = crop;
    for (const FilmTile& tile : window.tiles()) {
      const PixelBounds& b = tile.sampled();
      sampled = {std::min(sampled.x0, b.x0), std::min(sampled.y0, b.y0), std::max(sampled.x1, b.x1),
                 std::max(sampled.y1, b.y1)};
    }
    CHECK(sampled == crop);
    const Image a = cut_out.develop(), b = window.develop();
    const int reach = 2 * cut_out.filter().border();
    int within = 0, at_border = 0;
    for (int y = 0; y < a.height; ++y)
      for (int x = 0; x < a.width; ++x) {
        const bool inner = x >= reach && y >= reach && x < a.width - reach && y < a.height - reach;
        (inner ? within : at_border) += a.pixel(x, y)[0] != b.pixel(x, y)[0];
      }
    CHECK(within == 0);
    CHECK((at_border > 0) == (reach > 0));
  }
}

TEST_CASE("splats beyond the window do not count where the image ends there") {
  const PixelBounds crop{8, 8, 24, 24};
  for (const FilterKind kind : kKinds) {
    Film film({{32, 32}, crop, describe(kind), true}, {"R", "G", "B"});
    const size_t layer = film.add_splat_layer(0);
    std::vector<Splat> splats;
    constexpr int kPerPixel = 8;  // in each direction
    for (int y = 0; y < 32 * kPerPixel; ++y)
      for (int x = 0; x < 32 * kPerPixel; ++x) {
        const Point2f p{(float(x) + 0.5f) / kPerPixel, (float(y) + 0.5f) / kPerPixel};
        const bool beyond = p.x < 8 || p.y < 8 || p.x >= 24 || p.y >= 24;
        splats.push_back({p, Spectrum(beyond ? 100.0f : 1.0f)});
      }
    film.add_splats(layer, splats, 1.0f / (kPerPixel * kPerPixel));
    film.end_pass();
    const Image image = film.develop();
    for (size_t i = 0; i < image.data.size(); ++i)
      CHECK(image.data[i] == doctest::Approx(1).epsilon(0.01));
  }
}

TEST_CASE("a constant stays constant under every filter, also at the border") {
  for (const FilterKind kind : kKinds) {
    Film film({{21, 19}, {0, 0, 21, 19}, describe(kind)}, {"a", "b"});
    // Enough that the negative lobes cannot cancel a pixel's weight.
    fill(film, 16, [](const Point2f&) { return std::array<float, 2>{0.7f, -3}; });
    const Image image = film.develop();
    for (size_t i = 0; i < image.data.size(); i += 2) {
      CHECK(image.data[i] == doctest::Approx(0.7f).epsilon(1e-6));
      CHECK(image.data[i + 1] == doctest::Approx(-3).epsilon(1e-6));
    }
  }
}

TEST_CASE("pixels are means weighted by the filter at the distance of the sample") {
  for (const FilterKind kind : kKinds) {
    const FilterDescription description = describe(kind);
    Film film({{40, 40}, {0, 0, 40, 40}, description}, {"a"});
    // Two samples in tiles apart: the pixels between see both.
    const Point2f p{15.8f, 7.3f}, q{16.4f, 6.9f};
    const std::array<float, 1> a{1}, b{5};
    const auto tile_of = [&](const Point2f& s) -> FilmTile& {
      for (FilmTile& t : film.tiles())
        if (t.sampled().contains(int(s.x), int(s.y))) return t;
      throw std::runtime_error("no tile");
    };
    SampleAdder(film, tile_of(p)).add(15, 7, p, a);
    SampleAdder(film, tile_of(q)).add(16, 6, q, b);
    const Image image = film.develop();
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 40; ++x) {
        const auto weight = [&](const Point2f& s) {
          return evaluate_filter(description, x + 0.5 - double(s.x)) *
                 evaluate_filter(description, y + 0.5 - double(s.y));
        };
        const double wp = weight(p), wq = weight(q), sum = wp + wq;
        if (std::abs(sum) < 1e-3 && sum != 0) continue;  // badly conditioned
        const double expected = sum == 0 ? 0 : (wp + 5 * wq) / sum;
        CHECK(image.pixel(x, y)[0] == doctest::Approx(expected).epsilon(2e-2));
      }
  }
}

TEST_CASE("each film counts the same in a mean, however many samples its tiles have") {
  const PixelBounds crop{3, 2, 30, 20};
  for (const FilterKind kind : {FilterKind::box, FilterKind::gaussian}) {
    const auto film = [&](int spp) {
      Film f({{33, 21}, crop, describe(kind)}, {"a", "b"});
      for (FilmTile& tile : f.tiles()) tile.count_samples(uint32_t(spp));
      return f;
    };
    std::vector<Film> films;
    for (const int spp : {2, 2, 6}) films.push_back(film(spp));
    fill(films[0], 2, pattern);
    fill(films[1], 2, pattern);
    const Image before = films[0].develop();
    // The same samples three times: the weight of the film must not show.
    for (int i = 0; i < 3; ++i) fill(films[2], 2, pattern);
    CHECK(Film::develop(std::span(films).first(2)).data == before.data);
    const Image mean = Film::develop(films);
    for (size_t i = 0; i < mean.data.size(); ++i)
      CHECK(mean.data[i] == doctest::Approx(before.data[i]).epsilon(1e-6));

    std::vector<Film> unequal;
    for (const int spp : {1, 4}) unequal.push_back(film(spp));
    fill(unequal[0], 1, [](const Point2f&) { return std::array<float, 2>{1, 0}; });
    fill(unequal[1], 4, [](const Point2f&) { return std::array<float, 2>{3, 0}; });
    if (kind == FilterKind::box) {
      CHECK(Film::develop(unequal).pixel(5, 5)[0] == doctest::Approx(2));
      // One that has no samples yet is not black.
      unequal.push_back(film(0));
      CHECK(Film::develop(unequal).pixel(5, 5)[0] == doctest::Approx(2));
    }
  }
}

TEST_CASE("a tile with more samples does not weigh more beside its neighbours") {
  Film film({{32, 16}, {0, 0, 32, 16}, describe(FilterKind::gaussian)}, {"a", "b"});
  for (FilmTile& tile : film.tiles()) tile.count_samples(3);
  fill(film, 3, pattern);
  const Image even = film.develop();
  // The second tile gets the same samples five times over.
  film.tiles()[1].count_samples(12);
  for (int i = 0; i < 4; ++i) fill_tile(film, film.tiles()[1], 3, pattern);
  const Image uneven = film.develop();
  for (size_t i = 0; i < even.data.size(); ++i)
    CHECK(uneven.data[i] == doctest::Approx(even.data[i]).epsilon(1e-6));
}

TEST_CASE("a film without passes does not darken the splats of a mean") {
  std::vector<Film> films;
  for (int i = 0; i < 3; ++i) {
    films.emplace_back(FilmLayout{{16, 16}, {0, 0, 16, 16}, describe(FilterKind::box)},
                       std::vector<std::string>{"R", "G", "B"});
    films.back().add_splat_layer(0);
  }
  const Splat splat{{3.5f, 4.5f}, Spectrum(2.0f)};
  for (size_t i = 0; i < 2; ++i) {
    films[i].add_splats(0, std::span(&splat, 1), 1);
    films[i].end_pass();
  }
  CHECK(Film::develop(films).pixel(3, 4)[0] == 2);
}
