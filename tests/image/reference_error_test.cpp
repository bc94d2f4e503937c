// Errors against a reference with noise of its own.
#include "image/reference_error.h"

#include <doctest/doctest.h>

#include <stdexcept>

#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>

#include "image/metrics.h"
#include "support/constant_image.h"

using namespace duet;
using namespace duet::test;

namespace {

Image noisy(const Image& truth, double deviation, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<float> noise(0, float(deviation));
  Image image = truth;
  for (float& v : image.data) v += noise(generator);
  return image;
}

Image ramp(int width, int height) {
  Image image(width, height, {"R", "G", "B"});
  for (size_t i = 0; i < image.data.size(); ++i) image.data[i] = 0.2f + float(i % 97) / 50;
  return image;
}

}  // namespace

TEST_CASE("without noise the errors are those of compare") {
  const Image b = ramp(40, 30), a = noisy(b, 0.3, 1);
  const ImageMetrics m = compare_images(a, b, std::nullopt);
  const ReferenceErrors e = NoisyReference(b, nullptr).errors(a);
  CHECK(e.mse == doctest::Approx(m.rmse * m.rmse));
  CHECK(e.relmse == doctest::Approx(m.relmse));
  CHECK(e.trimmed == doctest::Approx(m.relmse_trimmed));
  CHECK(e.firefly == doctest::Approx(m.firefly));
  CHECK(std::accumulate(e.tile_pixels.begin(), e.tile_pixels.end(), 0.0) == 40 * 30 - 2);
  CHECK(std::accumulate(e.tile_sums.begin(), e.tile_sums.end(), 0.0) / (40 * 30 - 2) ==
        doctest::Approx(e.trimmed));
}

TEST_CASE("the noise of the reference is subtracted") {
  const Image truth = constant_image(96, 96, 1);
  const Image reference = noisy(truth, 0.1, 1), image = noisy(truth, 0.05, 2);
  const Image variance = constant_image(96, 96, 0.01f);
  const ReferenceErrors with = NoisyReference(reference, &variance).errors(image);
  const ReferenceErrors without = NoisyReference(reference, nullptr).errors(image);
  CHECK(without.mse == doctest::Approx(0.0125).epsilon(0.03));
  CHECK(with.mse == doctest::Approx(0.0025).epsilon(0.1));
  // The reference's noise in its own square moves these a little.
  CHECK(with.relmse == doctest::Approx(0.0025).epsilon(0.15));
  CHECK(with.trimmed == doctest::Approx(0.0025).epsilon(0.2));
  CHECK(NoisyReference(reference, &variance).noise() == doctest::Approx(0.01).epsilon(0.05));
  // Of the truth itself nothing is left, within the noise of that estimate.
  CHECK(std::abs(NoisyReference(reference, &variance).errors(truth).mse) < 4e-4);
}

TEST_CASE("errors stay in their tiles") {
  const Image b = constant_image(64, 64, 1);
  Image a = b;
  for (int y = 8; y < 16; ++y)
    for (int x = 16; x < 24; ++x) a.pixel(x, y)[1] = 1.5f;
  const ReferenceErrors e = NoisyReference(b, nullptr).errors(a);
  for (size_t i = 0; i < 64; ++i) {
    CAPTURE(i);
    if (i == 8 + 2)
      CHECK(e.tile_sums[i] == doctest::Approx(e.tile_pixels[i] * 0.25 / 1.01 / 3).epsilon(1e-5));
    else
      CHECK(e.tile_sums[i] == 0);
  }
}

TEST_CASE("what is not finite counts as black, and is no reference") {
  const Image b = constant_image(32, 32, 1);
  Image a = b;
  a.data[3] = NAN;
  CHECK(NoisyReference(b, nullptr).errors(a).mse == doctest::Approx(1.0 / 1024));
  CHECK_THROWS_AS(NoisyReference(a, nullptr), std::invalid_argument);
  CHECK_THROWS_AS(NoisyReference(b, &a), std::invalid_argument);
  const Image small = constant_image(16, 16, 1);
  CHECK_THROWS_AS(NoisyReference(b, &small), std::invalid_argument);
  CHECK_THROWS_AS(NoisyReference(b, nullptr).errors(small), std::invalid_argument);
}
