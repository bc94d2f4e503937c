// How often `duet compare --batches` calls two sets of images different whose means are equal.
//
//   calibrate_batches [TRIALS]
//
// The images are 64 values, one per tile, of four kinds of noise: normal; with one value in a
// hundred thirty deviations brighter; with a brightness that all tiles of an image share; and
// lognormal. The second set has half the deviation. Prints a table as Markdown.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "image/tile_test.h"

namespace {

using namespace duet;

enum class Noise { normal, bright, shared, lognormal };

TileBatches set_of(int count, Noise kind, double deviation, std::mt19937& generator) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  TileBatches batches;
  for (int i = 0; i < count; ++i) {
    Image image(TileBatches::kTiles, TileBatches::kTiles, {"Y"});
    const double shared = kind == Noise::shared ? normal(generator) : 0;
    for (float& v : image.data) {
      double noise = normal(generator);
      if (kind == Noise::bright) noise += (uniform(generator) < 0.01 ? 30 : 0) - 0.3;
      if (kind == Noise::lognormal) noise = std::exp(noise) - std::exp(0.5);
      v = float(10 + deviation * (noise + shared));
    }
    batches.add(image);
  }
  return batches;
}

}  // namespace

int main(int argc, char** argv) {
  const int trials = argc > 1 ? std::atoi(argv[1]) : 1000;
  const std::pair<const char*, Noise> kinds[] = {{"normal", Noise::normal},
                                                 {"rare bright", Noise::bright},
                                                 {"shared", Noise::shared},
                                                 {"lognormal", Noise::lognormal}};
  const std::pair<int, int> counts[] = {{2, 2}, {4, 16}, {8, 8}, {16, 16}, {32, 32}};
  fmt::print("| images | normal | rare bright | shared | lognormal |\n|---|--:|--:|--:|--:|\n");
  for (const auto& [a, b] : counts) {
    fmt::print("| {} and {} |", a, b);
    for (const auto& [name, kind] : kinds) {
      std::mt19937 generator(1);
      int alarms = 0;
      for (int i = 0; i < trials; ++i) {
        const TileBatches first = set_of(a, kind, 0.1, generator);
        alarms += !compare_tiles(first, set_of(b, kind, 0.05, generator)).equal();
      }
      fmt::print(" {:.1f} % |", 100.0 * alarms / trials);
      std::fflush(stdout);
    }
    fmt::print("\n");
  }
}
