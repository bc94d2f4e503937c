#include "image/tile_test.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <stdexcept>

using namespace duet;

namespace {

/// Images of 1 with noise; the tile in the upper left is `bias` brighter.
TileBatches batches(int count, double deviation, double bias, unsigned seed, int size = 32) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> noise(0, 1);
  TileBatches b;
  for (int i = 0; i < count; ++i) {
    Image image(size, size, {"R", "G", "B"});
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        const bool in_tile = x < size / 8 && y < size / 8;
        for (int c = 0; c < 3; ++c)
          image.pixel(x, y)[c] = float(1 + (in_tile ? bias : 0) + deviation * noise(generator));
      }
    b.add(image);
  }
  return b;
}

}  // namespace

TEST_CASE("sets of the same mean pass the tile test, however few and unequal") {
  for (const int count : {2, 4, 16}) {
    CAPTURE(count);
    int rejections = 0;
    double z2 = 0;
    for (unsigned seed = 0; seed < 20; ++seed) {
      const TileComparison c =
          compare_tiles(batches(count, 0.3, 0, 2 * seed), batches(16, 0.1, 0, 2 * seed + 1));
      rejections += c.rejected > 0;
      z2 += c.mean_z2 / 20;
      CHECK(c.tiles == 64);
      if (count == 16) CHECK(std::abs(c.ratio - 1) < 5 * c.ratio_error);
    }
    // Of 20 tests at 0.01 three or more fail with a probability of 0.001.
    CHECK(rejections < 3);
    // With few images the test is on the safe side.
    if (count == 16)
      CHECK(z2 == doctest::Approx(1).epsilon(0.1));
    else
      CHECK((z2 > 0.1 && z2 < 1));
  }
}

TEST_CASE("the tile test sees a bias of one tile that the mean hides") {
  // Tiles of 16 pixels and 3 channels: a mean of 16 images has the error 0.3 / sqrt(48 * 16).
  const double error = std::hypot(0.3, 0.3) / std::sqrt(48.0 * 16);
  const TileComparison c = compare_tiles(batches(16, 0.3, 8 * error, 1), batches(16, 0.3, 0, 2));
  CHECK(c.rejected == 1);
  CHECK_FALSE(c.equal());
  CHECK(c.worst_ratio == doctest::Approx(1 + 8 * error).epsilon(0.03));
  // What it says it can see: 3.78 and 0.84 standard errors, and some for the 30 degrees of freedom.
  CHECK(c.visible_bias == doctest::Approx(5.2 * error).epsilon(0.1));
  CHECK(c.visible_bias_worst < 2 * c.visible_bias);
  int seen = 0;
  for (unsigned seed = 10; seed < 50; ++seed)
    seen += compare_tiles(batches(16, 0.3, c.visible_bias, seed), batches(16, 0.3, 0, seed + 100))
                .rejected > 0;
  CHECK(seen >= 24);  // of 40, with a probability of 0.8 each
  CHECK(seen <= 39);
}

TEST_CASE("tiles that vary together are no bias") {
  // Images whose brightness varies as a whole, as when few light sub-paths serve all pixels.
  const auto set = [](unsigned seed) {
    std::mt19937 generator(seed);
    std::normal_distribution<double> noise(0, 1);
    TileBatches b;
    for (int i = 0; i < 16; ++i) {
      Image image(8, 8, {"R", "G", "B"});
      const double common = 1 + 0.1 * noise(generator);
      for (float& v : image.data) v = float(common * (1 + 0.05 * noise(generator)));
      b.add(image);
    }
    return b;
  };
  int alarms = 0, notable = 0;
  for (unsigned i = 0; i < 100; ++i) {
    const TileComparison c = compare_tiles(set(2 * i), set(2 * i + 1));
    alarms += !c.equal();
    notable += c.mean_z2 > 1.6;
  }
  CHECK(notable > 10);  // mean_z2 alone would say so
  // Of 100 tests at 0.01, six or more fail with a probability of 0.0005.
  CHECK(alarms < 6);
}

TEST_CASE("many small differences are found together") {
  // A bias of two standard errors in every tile, up and down by turns.
  int found = 0;
  for (unsigned seed = 0; seed < 10; ++seed) {
    std::mt19937 generator(seed);
    std::normal_distribution<double> noise(0, 1);
    TileBatches a, b;
    for (int i = 0; i < 32; ++i) {
      Image image(8, 8, {"Y"});
      for (size_t k = 0; k < 64; ++k)
        image.data[k] = float(1 + (i < 16 && k % 2 ? 0.07 : 0) - (i < 16 && k % 2 == 0 ? 0.07 : 0) +
                              0.1 * noise(generator));
      (i < 16 ? a : b).add(image);
    }
    const TileComparison c = compare_tiles(a, b);
    found += c.z2_p < 0.001;
    CHECK(c.mean_p > 0.001);
    CHECK_FALSE(c.equal());
  }
  CHECK(found == 10);
}

TEST_CASE("tiles without variance") {
  const TileComparison same = compare_tiles(batches(3, 0, 0, 1), batches(3, 0, 0, 2));
  CHECK(same.tiles == 0);
  CHECK(same.equal());
  // Rounding is not a difference.
  CHECK(compare_tiles(batches(3, 0, 1e-6, 1), batches(3, 0, 0, 2)).equal());
  const TileComparison other = compare_tiles(batches(3, 0, 0.01, 1), batches(3, 0, 0, 2));
  CHECK(other.rejected == 1);
  CHECK_FALSE(other.equal());
}

TEST_CASE("what the tile test cannot use") {
  TileBatches b = batches(2, 0.1, 0, 1);
  CHECK_THROWS_AS(b.add(Image(16, 16, {"R", "G", "B"})), std::invalid_argument);
  CHECK_THROWS_AS(batches(1, 0.1, 0, 1, 4), std::invalid_argument);
  CHECK_THROWS_AS(TileBatches().add(Image(16, 16, {"A"})), std::invalid_argument);
  CHECK_THROWS_AS(compare_tiles(b, batches(1, 0.1, 0, 2)), std::invalid_argument);
  TileBatches holes = batches(2, 0.1, 0, 3);
  Image image(32, 32, {"R", "G", "B"});
  image.data[0] = NAN;
  holes.add(image);
  CHECK_FALSE(compare_tiles(holes, b).equal());
}
