#include "duet/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "evaluate/compare/compare.h"
#include "evaluate/compare/json.h"
#include "evaluate/report/denoised_image.h"
#include "evaluate/report/scene_json.h"
#include "library/contents.h"

namespace duet {

namespace {

/// The image, if `check(image, name)` throws nothing.
const Image& checked(const ComparedImage& compared, const char* name,
                     void check(const Image&, const std::string&)) {
  const Image& image = compared.contents().linear.image;
  try {
    check(image, name);
  } catch (const std::runtime_error& e) {
    throw std::invalid_argument(e.what());
  }
  return image;
}

double checked_samples(double spp, const char* name) {
  if (!(spp > 0 && std::isfinite(spp)))
    throw std::invalid_argument(
        fmt::format("{}: {} samples per pixel are no positive number", name, spp));
  return spp;
}

}  // namespace

ComparedImage ComparedImage::load(const std::string& path) {
  check_path(path);
  try {
    return ComparedImage(std::make_shared<const Contents>(Contents{load_linear(path)}));
  } catch (const ReadError& e) {
    throw FileError(e.what());
  }
}

ComparedImage ComparedImage::from_pixels(std::span<const float> pixels, int width, int height,
                                         const std::vector<std::string>& channels) {
  Contents made;
  if (width < 1 || height < 1 || channels.empty() ||
      pixels.size() != size_t(width) * size_t(height) * channels.size())
    throw std::invalid_argument(fmt::format("{} numbers are not {} × {} × {}", pixels.size(),
                                            height, width, channels.size()));
  made.linear.image = Image(width, height, channels);
  std::copy(pixels.begin(), pixels.end(), made.linear.image.data.begin());
  return ComparedImage(std::make_shared<const Contents>(std::move(made)));
}

ComparedImage ComparedImage::from_image(const RenderedImage& image) {
  Contents made;
  made.linear.image = image.contents().image;
  for (const auto& [name, value] : image.metadata())
    if (name == kDenoiserField) made.linear.denoiser = std::get<std::string>(value);
  return ComparedImage(std::make_shared<const Contents>(std::move(made)));
}

std::string compare_images(const ComparedImage& image, const ComparedImage& reference,
                           const std::optional<ReferenceVariance>& variance, int threads) {
  checked(reference, "the reference", check_finite);
  std::optional<NoiseModel> noise;
  if (variance)
    noise = NoiseModel{&checked(variance->image, "the variance", check_variance),
                       checked_samples(variance->image_spp, "image_spp"),
                       checked_samples(variance->reference_spp, "reference_spp")};
  CompareSettings settings;
  settings.threads = threads_or_all(threads);
  Comparison comparison;
  measure(image.contents().linear, reference.contents().linear, noise, settings, kLongestOfOne,
          comparison);
  return json_text(comparison_json(settings, comparison));
}

}  // namespace duet
