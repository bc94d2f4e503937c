#include "image/batch_adder.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "media/random_stream.h"

using namespace duet;

namespace {

constexpr int kSize = Film::kTileSize;

FilterDescription filter_of(FilterKind kind, double radius = 0.5) {
  FilterDescription filter;
  filter.kind = kind;
  filter.radius = radius;
  return filter;
}

/// Filters whose reach is one to three pixels, as much along both axes or not.
std::vector<FilterDescription> some_filters() {
  FilterDescription pbrt = filter_of(FilterKind::gaussian),
                    uneven = filter_of(FilterKind::mitchell);
  pbrt.reach_x = pbrt.reach_y = 1.5;
  uneven.reach_x = 0.7, uneven.reach_y = 3;
  return {filter_of(FilterKind::gaussian),
          filter_of(FilterKind::tent, 1),
          filter_of(FilterKind::mitchell),
          filter_of(FilterKind::lanczos),
          filter_of(FilterKind::box, 1.5),
          filter_of(FilterKind::box, 2.1),
          pbrt,
          uneven};
}

/// The pixels of the full image that a batch for the tile has.
PixelBounds square_of(const Film& film, const FilmTile& tile) {
  const int x = tile.sampled().x0 / kSize * kSize, y = tile.sampled().y0 / kSize * kSize;
  return PixelBounds{x, y, x + kSize, y + kSize}.intersect(
      {0, 0, film.full_size().x, film.full_size().y});
}

/// What a batch may be like.
struct Kind {
  bool opaque = false, large = false;
};

struct Batch {
  BatchArray<float> x{}, y{}, r{}, g{}, b{}, alpha{};

  Batch(const PixelBounds& square, RandomStream& random, const Kind& kind) {
    const auto number = [&] {
      return std::ldexp(random.next() - 0.2f, int(45 * random.next()) - 40);
    };
    int i = 0;
    for (int py = square.y0; py < square.y1; ++py)
      for (int px = square.x0; px < square.x1; ++px, ++i) {
        x[i] = float(px) + offset(random), y[i] = float(py) + offset(random);
        r[i] = number(), g[i] = number(), b[i] = number();
        alpha[i] = kind.opaque || random.next() < 0.9f ? 1.0f : 0.0f;
        if (kind.large && random.next() < 0.02f) (random.next() < 0.5f ? r : b)[i] = -3e9f * r[i];
      }
  }

  /// Often where a filter begins or ends to reach a pixel.
  static float offset(RandomStream& random) {
    static const float kEdges[] = {0, 0.5f, 0x1.fffffep-1f, 0.6f, 0.9f};
    const float u = random.next();
    if (u > 0.4f) return random.next();
    const float edge = kEdges[int(u * 12.5f)];
    return edge + 1e-6f * std::round(2 * random.next()) * (edge < 0.95f);
  }
};

void add_one_by_one(SampleAdder& sums, const FilmTile& tile, const PixelBounds& square,
                    const Batch& batch) {
  int i = 0;
  for (int py = square.y0; py < square.y1; ++py)
    for (int px = square.x0; px < square.x1; ++px, ++i)
      if (tile.sampled().contains(px, py))
        sums.add(px, py, {batch.x[i], batch.y[i]},
                 std::array{batch.r[i], batch.g[i], batch.b[i], batch.alpha[i]});
}

/// How many sums of the film's tiles differ between the two ways to add batches.
size_t differences(const Film& film, int batches, const Kind& first, const Kind& second) {
  size_t count = 0;
  for (const FilmTile& tile : film.tiles()) {
    FilmTile together = tile, singly = tile;
    const PixelBounds square = square_of(film, tile);
    RandomStream random(uint64_t(square.x0 + 1000 * square.y0));
    {
      BatchAdder sums(film, together, square);
      SampleAdder expected(film, singly);
      for (int i = 0; i < batches; ++i) {
        const Batch b(square, random, i % 2 == 0 ? first : second);
        sums.add({b.x, b.y, b.r, b.g, b.b, b.alpha});
        add_one_by_one(expected, singly, square, b);
      }
    }
    for (size_t i = 0; i < singly.sums().size(); ++i)
      count += !(together.sums()[i] == singly.sums()[i]);
  }
  return count;
}

}  // namespace

TEST_CASE("batches have the sums that their samples have one by one") {
  for (const FilterDescription& filter : some_filters()) {
    CAPTURE(int(filter.kind));
    // Tiles that the image cuts off, and those that a window does.
    for (const PixelBounds& crop : {PixelBounds{0, 0, 40, 24}, PixelBounds{5, 3, 21, 20}}) {
      const Film film({{40, 24}, crop, filter}, {"R", "G", "B", "A"});
      REQUIRE(BatchAdder::suits(film));
      CHECK(differences(film, 6, {.opaque = true}, {.opaque = true}) == 0);
      CHECK(differences(film, 6, {}, {.opaque = true}) == 0);
      CHECK(differences(film, 6, {.large = true}, {.opaque = true, .large = true}) == 0);
    }
  }
}

TEST_CASE("batches keep the largest of small numbers, and the smallest, however many there are") {
  // Of whose weights many are one: after 500 batches sums are above 2¹⁹.
  const Film film({{16, 16}, {0, 0, 16, 16}, filter_of(FilterKind::box, 3)}, {"R", "G", "B", "A"});
  const PixelBounds square{0, 0, 16, 16};
  for (const float v : {std::nextafter(32.0f, 0.0f), 32.0f, 0x1p-149f, 1e-17f, 0x1.fffffep-20f}) {
    CAPTURE(v);
    FilmTile together = film.tiles()[0], singly = together;
    RandomStream random(4);
    Batch batch(square, random, {.opaque = true});
    batch.r.fill(v), batch.g.fill(-v);
    {
      BatchAdder sums(film, together, square);
      SampleAdder expected(film, singly);
      for (int i = 0; i < 1000; ++i) {
        sums.add({batch.x, batch.y, batch.r, batch.g, batch.b, batch.alpha});
        add_one_by_one(expected, singly, square, batch);
      }
    }
    CHECK(std::equal(together.sums().begin(), together.sums().end(), singly.sums().begin()));
  }
}

TEST_CASE("batches are for colours and alpha under filters of a few pixels") {
  const auto suits = [](const FilmLayout& layout, std::vector<std::string> channels) {
    return BatchAdder::suits(Film(layout, std::move(channels)));
  };
  FilmLayout layout{{16, 16}, {0, 0, 16, 16}, filter_of(FilterKind::gaussian)};
  CHECK(suits(layout, {"R", "G", "B", "A"}));
  CHECK(!suits(layout, {"R", "G", "B"}));
  CHECK(!suits(layout, {"R", "G", "B", "A", "depth.Y"}));
  FilmLayout limited = layout;
  limited.sample_limit = SampleLimit{.most = 3};
  CHECK(!suits(limited, {"R", "G", "B", "A"}));
  for (const FilterDescription& f : some_filters())
    CHECK(suits({{16, 16}, {0, 0, 16, 16}, f}, {"R", "G", "B", "A"}));
  CHECK(!suits({{16, 16}, {0, 0, 16, 16}, filter_of(FilterKind::box)}, {"R", "G", "B", "A"}));
  layout.filter = filter_of(FilterKind::lanczos);
  layout.filter.lobes = 4;
  CHECK(!suits(layout, {"R", "G", "B", "A"}));
}
