// When a denoised image is believed.
#include "image/denoiser_bias.h"

#include <doctest/doctest.h>

#include <cmath>

#include "math/hash.h"

using namespace duet;

namespace {

constexpr int kNoisySize = 32;

/// Colours of 1 with noise of this variance, and other noise that tells it.
ImageWithNoise noisy_one(double variance) {
  ImageWithNoise image{kNoisySize, kNoisySize, {}, {}};
  const auto noise = [&](uint64_t i) {
    return std::sqrt(12 * variance) * (double(mix64(i) >> 11) * 0x1p-53 - 0.5);
  };
  for (uint64_t i = 0; i < 3 * kNoisySize * kNoisySize; ++i) {
    image.colour.push_back(float(1 + noise(2 * i)));
    image.noise.push_back(float(noise(2 * i + 1)));
  }
  return image;
}

/// What is left of the noisy image's colours by a denoiser that sees the same whatever they are.
std::vector<float> limited_constant(const ImageWithNoise& noisy, double colour) {
  std::vector<float> denoised(noisy.colour.size(), float(colour));
  limit_bias(
      noisy, [&](std::vector<float>) { return denoised; }, denoised);
  return denoised;
}

double mean_square_error(const std::vector<float>& colour, double truth) {
  double sum = 0;
  for (const float c : colour) sum += (double(c) - truth) * (double(c) - truth);
  return sum / double(colour.size());
}

}  // namespace

TEST_CASE("a denoised image that differs by no more than noise is believed") {
  CHECK(mean_square_error(limited_constant(noisy_one(0.01), 1), 1) < 0.01 / 20);
}

TEST_CASE("a denoised image that is wrong without noise is not believed at all") {
  const ImageWithNoise noisy = noisy_one(0);
  CHECK(limited_constant(noisy, 0.5) == noisy.colour);
}

TEST_CASE("whatever the bias, the error is hardly above that of the noise") {
  const double variance = 0.01;
  for (const double bias : {0.05, 0.1, 0.2, 0.5}) {
    CAPTURE(bias);
    const std::vector<float> limited = limited_constant(noisy_one(variance), 1 + bias);
    CHECK(mean_square_error(limited, 1) < 1.05 * variance);
  }
}

TEST_CASE("noise that is not seen is not taken") {
  const ImageWithNoise noisy = noisy_one(0.002 * 0.002);
  CHECK(limited_constant(noisy, 1.001) == noisy.colour);
}

TEST_CASE("noise that the denoiser has kept explains no difference") {
  const ImageWithNoise noisy = noisy_one(0.01);
  // Keeps all of the noise and adds less than it. What it has added goes.
  const auto denoise = [](std::vector<float> colours) {
    for (float& c : colours) c += 0.09f;
    return colours;
  };
  std::vector<float> denoised = denoise(noisy.colour);
  const double noise = mean_square_error(noisy.colour, 1);
  REQUIRE(mean_square_error(denoised, 1) > 1.7 * noise);
  limit_bias(noisy, denoise, denoised);
  CHECK(mean_square_error(denoised, 1) < 1.01 * noise);
}
