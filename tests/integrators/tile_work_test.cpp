#include "integrators/tile_work.h"

#include <doctest/doctest.h>

#include <map>
#include <mutex>
#include <tuple>

#include "image/sample_adder.h"

using namespace duet;

namespace {

FilmLayout small_layout() {
  FilmLayout layout{{48, 40}, {3, 2, 40, 38}, {}};
  layout.filter.kind = FilterKind::gaussian;
  return layout;
}

/// How often each sample of each pixel was taken, and the film.
struct Taken {
  std::map<std::tuple<int, int, uint32_t>, int> times;
  Film film{small_layout(), {"R"}};
  RenderCounters counters;
  size_t calls = 0;
};

void take(const SampleRange& range, int threads, TileSplit split, Taken& taken) {
  std::mutex mutex;
  PassControl control;
  control.threads = threads;
  for_each_tile(taken.film, range, control, split, taken.counters,
                [&](FilmTile& tile, const TileSamples& samples, RenderCounters& c) {
                  const std::lock_guard lock(mutex);
                  ++taken.calls;
                  SampleAdder sums(taken.film, tile);
                  const PixelBounds& b = tile.sampled();
                  for (int y = b.y0; y < b.y1; ++y)
                    for (int x = b.x0; x < b.x1; ++x)
                      for (uint32_t i = samples.first; i < samples.first + samples.count; ++i) {
                        ++taken.times[{x, y, i}];
                        ++c.camera_paths;
                        const float value[]{1 / float(1 + x + y) + float(i)};
                        sums.add(x, y, {float(x) + 0.3f, float(y) + 0.9f}, value);
                      }
                });
}

}  // namespace

TEST_CASE("threads share the samples of few tiles, and the sums are the same bits") {
  const size_t tiles = Film(small_layout(), {"R"}).tiles().size();
  std::vector<TileSamples> unequal(tiles);
  for (size_t k = 0; k < tiles; ++k)
    unequal[k] = {uint32_t(5 * k), uint32_t(k % 4 == 0 ? 0 : 17 * k)};
  SampleRange one, many, of_tiles;
  one.first = 7, one.count = 1;
  many.first = 2, many.count = 50;
  of_tiles.count = 1000, of_tiles.tiles = unequal;
  for (const SampleRange& range : {one, many, of_tiles}) {
    Taken alone;
    take(range, 1, TileSplit::by_samples, alone);
    for (const int threads : {2, 16, 64})
      for (const TileSplit split : {TileSplit::by_samples, TileSplit::by_samples_and_rows}) {
        CAPTURE(range.count);
        CAPTURE(threads);
        Taken shared;
        take(range, threads, split, shared);
        CHECK(shared.times == alone.times);
        CHECK(shared.counters.camera_paths == alone.counters.camera_paths);
        CHECK(shared.film.develop().data == alone.film.develop().data);
        for (size_t k = 0; k < tiles; ++k)
          CHECK(shared.film.tiles()[k].samples() == samples_of_tile(range, k).count);
        const bool divides = split == TileSplit::by_samples_and_rows || range.count > 1;
        if (threads == 64 && divides) CHECK(shared.calls > 2 * tiles);
      }
    for (const auto& [sample, times] : alone.times) CHECK(times == 1);
  }
}
