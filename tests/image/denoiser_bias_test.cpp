// When a denoised image is believed.
#include "image/denoiser_bias.h"

#include <doctest/doctest.h>

#include <cmath>

#include "math/hash.h"

using namespace duet;

namespace {

constexpr int kNoisySize = 32;

/// Colours of 1 with noise of this variance, which is known.
ImageWithNoise noisy_one(double variance) {
  ImageWithNoise image{
      kNoisySize, kNoisySize, {}, std::vector<float>(3 * kNoisySize * kNoisySize, float(variance))};
  for (size_t i = 0; i < image.variance.size(); ++i) {
    const double u = double(mix64(i) >> 11) * 0x1p-53;
    image.colour.push_back(float(1 + std::sqrt(12 * variance) * (u - 0.5)));
  }
  return image;
}

double mean_square_error(const std::vector<float>& colour, double truth) {
  double sum = 0;
  for (const float c : colour) sum += (double(c) - truth) * (double(c) - truth);
  return sum / double(colour.size());
}

}  // namespace

TEST_CASE("a denoised image that differs by no more than noise is believed") {
  const ImageWithNoise noisy = noisy_one(0.01);
  std::vector<float> denoised(noisy.colour.size(), 1);
  limit_bias(noisy, denoised);
  CHECK(mean_square_error(denoised, 1) < 0.01 / 20);
}

TEST_CASE("a denoised image that is wrong without noise is not believed at all") {
  const ImageWithNoise noisy = noisy_one(0);
  std::vector<float> denoised(noisy.colour.size(), 0.5f);
  limit_bias(noisy, denoised);
  CHECK(denoised == noisy.colour);
}

TEST_CASE("whatever the bias, the error is hardly above that of the noise") {
  const double variance = 0.01;
  for (const double bias : {0.05, 0.1, 0.2, 0.5}) {
    CAPTURE(bias);
    const ImageWithNoise noisy = noisy_one(variance);
    std::vector<float> denoised(noisy.colour.size(), float(1 + bias));
    limit_bias(noisy, denoised);
    CHECK(mean_square_error(denoised, 1) < 1.05 * variance);
  }
}
