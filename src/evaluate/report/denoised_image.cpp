#include "evaluate/report/denoised_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <stdexcept>

#include "image/cryptomatte.h"
#include "image/denoiser_bias.h"
#include "integrators/layers.h"

namespace duet {

namespace {

constexpr const char* kAlbedo = "denoise_albedo";
constexpr const char* kNormal = "denoise_normal";
constexpr const char* kSplit = "denoise_split";
/// With fewer samples in one of two halves nothing is known of the noise.
constexpr float kLeastShare = 0.1f;

bool is_among(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Three channels that follow each other.
std::vector<float> triples(const Image& image, const std::string& first) {
  const int c = image.find_channel(first);
  if (c < 0) throw std::logic_error("the image has no channel " + first);
  std::vector<float> out;
  out.reserve(3 * size_t(image.width) * size_t(image.height));
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      out.insert(out.end(), image.pixel(x, y) + c, image.pixel(x, y) + c + 3);
  return out;
}

/// The noise of each colour: the means of two independent halves of the samples, of which one has
/// the share p of all, differ by a and p (1 - p) a^2 is an estimate of the variance of the whole.
/// Empty where there are no two halves.
std::optional<ImageWithNoise> noise_of(const Image& image) {
  ImageWithNoise known{image.width, image.height, triples(image, "R"),
                       triples(image, std::string(kSplit) + ".R")};
  const int signs = image.find_channel(std::string(kSplit) + ".S");
  for (size_t i = 0; i < known.colour.size(); ++i) {
    const float sign = image.data[i / 3 * image.channels.size() + size_t(signs)];
    const float p = 0.5f * (1 + sign), mean = known.colour[i];
    if (!(std::min(p, 1 - p) >= kLeastShare)) return std::nullopt;
    float& split = known.noise[i];
    const float a = 0.5f * (mean + split) / p - 0.5f * (mean - split) / (1 - p);
    split = std::sqrt(p * (1 - p)) * a;
  }
  return known;
}

}  // namespace

std::vector<std::string> add_denoiser_layers(IntegratorDescription& integrator,
                                             const IntegratorOverride& override_with) {
  const std::string& method = override_with.name;
  if (method.empty() ? !integrator.image : method == "aov")
    throw std::invalid_argument("the image has layers only, no colours to denoise");
  std::vector<AovDescription::Layer>& layers = integrator.aovs.layers;
  std::vector<std::string> added;
  for (const std::string name : {kAlbedo, kNormal, kSplit}) {
    const AovDescription::Layer layer{name, name};
    if (std::find(layers.begin(), layers.end(), layer) != layers.end()) continue;
    layers.push_back(layer);
    if (is_among(override_with.layers, name)) continue;
    for (const std::string& channel : layer_channels({*find_layer(name), name}))
      added.push_back(channel);
  }
  return added;
}

Image without_channels(const Image& image, const std::vector<std::string>& names) {
  std::vector<std::string> kept;
  std::vector<size_t> places;
  for (size_t c = 0; c < image.channels.size(); ++c)
    if (!is_among(names, image.channels[c])) {
      kept.push_back(image.channels[c]);
      places.push_back(c);
    }
  Image out(image.width, image.height, kept);
  float* to = out.data.data();
  for (size_t at = 0; at < image.data.size(); at += image.channels.size())
    for (const size_t place : places) *to++ = image.data[at + place];
  return out;
}

Image denoised_image(const Denoiser& denoiser, const Image& image, bool tells_noise) {
  DenoiserGuides guides{image.width, image.height, triples(image, std::string(kAlbedo) + ".R"),
                        triples(image, std::string(kNormal) + ".X")};
  // Estimates are above 1 here and there.
  for (float& v : guides.albedo) v = std::clamp(v, 0.0f, 1.0f);
  guides = denoiser.clean(std::move(guides));
  const auto denoise = [&](std::vector<float> colours) {
    return denoiser.denoise(guides, std::move(colours));
  };
  std::vector<float> colours = denoise(triples(image, "R"));
  if (tells_noise)
    if (const auto known = noise_of(image)) limit_bias(*known, denoise, colours);
  const int alpha = image.find_channel("A");
  Image out(image.width, image.height, {"R", "G", "B"});
  if (alpha >= 0) out = Image(image.width, image.height, {"R", "G", "B", "A"});
  size_t from = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x, from += 3) {
      std::copy_n(&colours[from], 3, out.pixel(x, y));
      if (alpha >= 0) out.pixel(x, y)[3] = image.pixel(x, y)[alpha];
    }
  return out;
}

HeaderFields denoised_header(HeaderFields header, const std::string& denoiser) {
  std::string bias = fmt::format("denoised by {}, which trades noise for bias", denoiser);
  for (auto field = header.begin(); field != header.end();) {
    if (field->first == "bias") {
      bias = std::get<std::string>(field->second) + "; " + bias;
      field = header.erase(field);
    } else if (field->first.starts_with("relative") || field->first.starts_with(kMatteFields)) {
      // Estimates of the noise that was, and layers that this image has not.
      field = header.erase(field);
    } else {
      ++field;
    }
  }
  header.emplace_back(kDenoiserField, denoiser);
  header.emplace_back("bias", bias);
  return header;
}

std::string denoised_path(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  return path.substr(0, path.size() - extension.size()) + ".denoised" + extension;
}

}  // namespace duet
