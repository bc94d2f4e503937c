#include "evaluate/compare/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "base/file_names.h"
#include "evaluate/compare/verdict.h"
#include "image/image_io.h"

namespace duet {

namespace fs = std::filesystem;

namespace {

/// The samples per pixel that are given, or those in the header of the image.
double samples_of(UnknownSamples::Of of, const std::string& path, const LinearImage& image,
                  const std::optional<double>& given) {
  if (given) return *given;
  if (const double spp = std::atof(image.spp.c_str()); spp > 0) return spp;
  throw UnknownSamples(of, path);
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

void measure(const LinearImage& image, const LinearImage& reference,
             const std::optional<NoiseModel>& noise, const CompareSettings& settings, int longest,
             Comparison& c) {
  Measurements& m = c.measurements;
  m.metrics = compare_images(image.image, reference.image, noise);
  m.display = display_metrics(image.image, reference.image);
  m.percentage = percentage_errors(image.image, reference.image);
  FlipResult flip = ldr_flip(image.image, reference.image);
  m.flip = flip.mean;
  if (!(image.display_encoded && reference.display_encoded))
    if (auto hdr = hdr_flip(image.image, reference.image, settings.threads)) {
      m.hdr_flip = hdr->mean;
      flip = std::move(*hdr);
    }
  if (noise) m.bias_test = test_bias(image.image, reference.image, *noise);
  c.missed = missed_of(settings.requirements, m);
  c.verdict = judge(m, settings.requirements, c.missed);
  c.warning = clipping_warning(image, reference);
  if (noise && c.warning.empty()) c.warning = denoised_warning(image);
  c.tells_noise = noise.has_value() || m.tiles.has_value();
  if (settings.for_page) add_images(image.image, reference.image, flip, longest, c);
}

void refuse_denoised(const CompareSettings& settings, const LinearImage& image,
                     const std::string& path) {
  if (image.denoiser.empty()) return;
  for (const Requirement& r : settings.requirements)
    for (const Figure& f : figures({}))
      if (f.name == r.figure && !f.needs.empty())
        throw std::runtime_error(fmt::format(
            "{} was denoised by {} and is biased: --require \"{}\" is for images as they "
            "were rendered",
            path, image.denoiser, r.text));
}

void write_differences(const CompareSettings& settings, const Image& image, const Image& reference,
                       const ImageMetrics& m) {
  const auto write = [&](const std::string& path, const std::vector<uint8_t>& bytes) {
    write_display_image(path, image.width, image.height, 3, bytes);
  };
  const DifferencePaths& o = settings.differences;
  // Full colour at half the mean of the reference.
  const double mean = m.relative_rmse > 0 ? m.rmse / m.relative_rmse : 1;
  if (!o.diff.empty()) write(o.diff, difference_image(image, reference, 0.5 * mean));
  if (!o.false_colour.empty())
    write(o.false_colour, false_colours(relative_differences(image, reference)));
  if (o.flip_map.empty()) return;
  const auto hdr = hdr_flip(image, reference, settings.threads);
  write(o.flip_map, false_colours(hdr ? hdr->map : ldr_flip(image, reference).map));
}

Comparison compare_pair(const CompareSettings& o, int longest) {
  const LinearImage image = load_linear(o.image), reference = load_linear(o.reference);
  check_finite(reference.image, o.reference);
  refuse_denoised(o, image, o.image);
  std::optional<NoiseModel> noise;
  LinearImage variance;
  if (!o.variance.empty()) {
    variance = load_linear(o.variance);
    check_variance(variance.image, o.variance);
    noise = NoiseModel{
        &variance.image, samples_of(UnknownSamples::Of::image, o.image, image, o.spp),
        samples_of(UnknownSamples::Of::reference, o.reference, reference, o.reference_spp)};
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
    const std::string e = extension_of(entry.path().string());
    if (std::find(std::begin(extensions), std::end(extensions), e) != std::end(extensions))
      names.push_back(entry.path().lexically_relative(directory).generic_string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace duet
