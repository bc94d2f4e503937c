// Open Image Denoise itself, where it is installed; tests/app/denoise_test.cpp needs none.
#include "image/denoiser.h"

#include <doctest/doctest.h>

#include <cmath>
#include <optional>
#include <stdexcept>

#include "math/hash.h"

using namespace duet;

namespace {

/// The denoiser, or null with the reason printed.
std::optional<Denoiser> installed_denoiser(int threads) {
  try {
    return std::optional<Denoiser>(std::in_place, threads);
  } catch (const std::runtime_error& e) {
    MESSAGE("skipped: ", std::string(e.what()));
    return std::nullopt;
  }
}

constexpr int kDenoisedSize = 64;

struct NoisyImage {
  std::vector<float> colours;
  DenoiserGuides guides{kDenoisedSize, kDenoisedSize, {}, {}};
};

/// Two areas of one colour each, with noise as large as the colours.
NoisyImage noisy_image() {
  NoisyImage image;
  for (int i = 0; i < kDenoisedSize * kDenoisedSize; ++i) {
    const float albedo = i % kDenoisedSize < kDenoisedSize / 2 ? 0.25f : 0.75f;
    for (int c = 0; c < 3; ++c) {
      image.colours.push_back(albedo * 2 * float(mix64(uint64_t(3 * i + c)) % 1000) / 999);
      image.guides.albedo.push_back(albedo);
      image.guides.normal.push_back(c == 2 ? 1.0f : 0.0f);
    }
  }
  return image;
}

std::vector<float> denoised(const Denoiser& denoiser, const NoisyImage& image) {
  DenoiserGuides guides = denoiser.clean(image.guides);
  return denoiser.denoise(guides, image.colours);
}

double mean_square_error(const std::vector<float>& colour, const std::vector<float>& truth) {
  double sum = 0;
  for (size_t i = 0; i < colour.size(); ++i) sum += std::pow(double(colour[i] - truth[i]), 2);
  return sum / double(colour.size());
}

}  // namespace

TEST_CASE("the denoiser takes nearly all of the noise, whatever the number of threads") {
  const auto denoiser = installed_denoiser(1);
  if (!denoiser) return;
  CHECK(denoiser->name().starts_with("Open Image Denoise 2."));
  const NoisyImage noisy = noisy_image();
  const std::vector<float> clean = denoised(*denoiser, noisy);
  const std::vector<float>& truth = noisy.guides.albedo;
  CHECK(mean_square_error(clean, truth) < mean_square_error(noisy.colours, truth) / 50);
  CHECK(denoised(*installed_denoiser(2), noisy) == clean);
}

TEST_CASE("the denoiser takes images of one pixel, and values that are not colours") {
  const auto denoiser = installed_denoiser(1);
  if (!denoiser) return;
  CHECK(denoised(*denoiser, {{0.5f, 0.5f, 0.5f}, {1, 1, {1, 1, 1}, {0, 0, 1}}}).size() == 3);
  NoisyImage odd = noisy_image();
  odd.colours[0] = NAN, odd.colours[10] = INFINITY, odd.colours[20] = -5;
  for (const float v : denoised(*denoiser, odd)) CHECK((std::isfinite(v) && v >= 0));
}
