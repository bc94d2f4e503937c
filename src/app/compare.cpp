#include "app/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "app/arguments.h"
#include "app/commands.h"
#include "app/compare_verdict.h"
#include "app/output.h"
#include "base/log.h"
#include "image/colours.h"
#include "image/image_io.h"
#include "math/spectrum.h"

namespace duet {

namespace fs = std::filesystem;

namespace {

/// The samples per pixel that the option says, or the header of the image.
double samples_of(const std::string& path, const LinearImage& image, const std::string& option,
                  const std::string& given) {
  if (!given.empty()) return parse_amount(option, given, {{"", 1}}, 1e-3, 1e15);
  if (const double spp = std::atof(image.spp.c_str()); spp > 0) return spp;
  throw UsageError(
      fmt::format("--variance also needs {}: the header of {} does not say how many samples it has",
                  option, path));
}

void add_images(const Image& image, const Image& reference, const FlipResult& flip, int longest,
                Comparison& c) {
  WebImage a = web_image(image, longest), b = web_image(reference, longest);
  const std::string note =
      a.reduced_by > 1 ? fmt::format("reduced to 1/{} for this page", a.reduced_by) : "";
  const WebFlip map = web_flip(flip, image.width, longest);
  c.images = {{"image", note, std::move(a), map}, {"reference", note, std::move(b), {}}};
}

}  // namespace

LinearImage load_linear(const std::string& path) {
  ImageFile file = read_image(path);
  LinearImage linear;
  linear.image = std::move(file.image);
  linear.display_encoded = file.display_encoded;
  for (const auto& [name, value] : file.header)
    if (name == "spp") linear.spp = value;
  linear.header = std::move(file.header);
  if (!file.display_encoded) return linear;
  std::vector<float>& data = linear.image.data;
  if (!file.bytes.empty()) {
    data.resize(file.bytes.size());
    for (size_t i = 0; i < file.bytes.size(); ++i) data[i] = float(file.bytes[i]) / 255;
  }
  for (float& v : data) v = srgb_to_linear(v);
  return linear;
}

void check_finite(const Image& image, const std::string& path) {
  const Colours colours(image);
  for (size_t i = 0; i < colours.pixels(); ++i)
    for (int c = 0; c < 3; ++c)
      if (!std::isfinite(colours(i, c)))
        throw std::runtime_error(fmt::format("{} has values that are not finite", path));
}

void measure(const LinearImage& image, const LinearImage& reference,
             const std::optional<NoiseModel>& noise, const CompareOptions& options, int longest,
             Comparison& c) {
  Measurements& m = c.measurements;
  m.metrics = compare_images(image.image, reference.image, noise);
  m.display = display_metrics(image.image, reference.image);
  m.percentage = percentage_errors(image.image, reference.image);
  FlipResult flip = ldr_flip(image.image, reference.image);
  m.flip = flip.mean;
  if (!(image.display_encoded && reference.display_encoded))
    if (auto hdr = hdr_flip(image.image, reference.image, options.threads)) {
      m.hdr_flip = hdr->mean;
      flip = std::move(*hdr);
    }
  if (noise) m.bias_test = test_bias(image.image, reference.image, *noise);
  c.missed = missed_of(options.requirements, m);
  c.verdict = judge(m, options.requirements, c.missed);
  c.warning = clipping_warning(image, reference);
  if (!c.warning.empty()) log::warning("{}: {}", options.image, c.warning);
  c.tells_noise = noise.has_value() || m.tiles.has_value();
  if (longest > 0) add_images(image.image, reference.image, flip, longest, c);
}

void write_differences(const CompareOptions& o, const Image& image, const Image& reference,
                       const ImageMetrics& m) {
  const auto write = [&](const std::string& path, const std::vector<uint8_t>& bytes) {
    write_display_image(path, image.width, image.height, 3, bytes);
  };
  // Full colour at half the mean of the reference.
  const double mean = m.relative_rmse > 0 ? m.rmse / m.relative_rmse : 1;
  if (!o.diff.empty()) write(o.diff, difference_image(image, reference, 0.5 * mean));
  if (!o.false_colour.empty())
    write(o.false_colour, false_colours(relative_differences(image, reference)));
  if (o.flip_map.empty()) return;
  const auto hdr = hdr_flip(image, reference, o.threads);
  write(o.flip_map, false_colours(hdr ? hdr->map : ldr_flip(image, reference).map));
}

Comparison compare_pair(const CompareOptions& o, int longest) {
  const LinearImage image = load_linear(o.image), reference = load_linear(o.reference);
  check_finite(reference.image, o.reference);
  std::optional<NoiseModel> noise;
  LinearImage variance;
  if (!o.variance.empty()) {
    variance = load_linear(o.variance);
    check_finite(variance.image, o.variance);
    noise = NoiseModel{&variance.image, samples_of(o.image, image, "--spp", o.spp),
                       samples_of(o.reference, reference, "--reference-spp", o.reference_spp)};
  }
  Comparison c;
  c.name = fs::path(o.image).filename().string();
  measure(image, reference, noise, o, longest, c);
  write_differences(o, image.image, reference.image, c.measurements.metrics);
  return c;
}

std::vector<std::string> images_in(const std::string& directory) {
  static constexpr const char* extensions[] = {".exr", ".png", ".jpg", ".jpeg", ".hdr", ".pfm",
                                               ".bmp", ".tga", ".tif", ".tiff", ".ppm"};
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(directory)) {
    if (!entry.is_regular_file()) continue;
    std::string e = entry.path().extension().string();
    std::transform(e.begin(), e.end(), e.begin(),
                   [](unsigned char ch) { return char(std::tolower(ch)); });
    if (std::find(std::begin(extensions), std::end(extensions), e) != std::end(extensions))
      names.push_back(entry.path().lexically_relative(directory).generic_string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace duet
