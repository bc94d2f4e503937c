#include "duet/rendered_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/system/atomic_file.h"
#include "evaluate/report/exposure.h"
#include "evaluate/report/image_file.h"
#include "library/contents.h"

namespace duet {

namespace {

DisplaySettings settings_of(const DisplayForm& display) {
  if (display.png_depth != 8 && display.png_depth != 16)
    throw std::invalid_argument(
        fmt::format("PNG files have 8 or 16 bits, not {}", display.png_depth));
  // Written so that NaN is refused.
  if (!(std::abs(display.exposure) <= kMaxExposure))
    throw std::invalid_argument("exposure: " +
                                not_an_exposure(fmt::format("{}", display.exposure)));
  DisplaySettings settings{display.exposure, display.automatic_exposure, {}, display.png_depth};
  if (display.tone_map.empty()) return settings;
  settings.curve = tone_curve_of(display.tone_map);
  if (!settings.curve)
    throw std::invalid_argument(fmt::format("there is no tone mapping \"{}\"; there are {}",
                                            display.tone_map, fmt::join(kToneCurveNames, " ")));
  return settings;
}

FileSettings settings_of(const DisplayForm& display, const ExrForm& exr) {
  const std::optional<AovNames> names = aov_names_of(exr.aov_names);
  if (!names)
    throw std::invalid_argument(fmt::format("there are no names \"{}\"; there are {}",
                                            exr.aov_names, fmt::join(kAovNames, " ")));
  return {settings_of(display), *names, exr.parts};
}

}  // namespace

RenderedImage RenderedImage::from_rgba(std::span<const float> pixels, int width, int height) {
  Contents made{{width, height, {"R", "G", "B", "A"}}, {}, {}, false};
  if (width < 1 || height < 1 || pixels.size() != made.image.data.size())
    throw std::invalid_argument(
        fmt::format("{} numbers are not {} × {} × 4", pixels.size(), height, width));
  std::copy(pixels.begin(), pixels.end(), made.image.data.begin());
  made.form.crop = {0, 0, width, height};
  made.form.full_size = {width, height};
  made.form.half = false;
  return RenderedImage(std::make_shared<const Contents>(std::move(made)));
}

int RenderedImage::width() const {
  return contents_->image.width;
}

int RenderedImage::height() const {
  return contents_->image.height;
}

const std::vector<std::string>& RenderedImage::channels() const {
  return contents_->image.channels;
}

std::span<const float> RenderedImage::pixels() const {
  return contents_->image.data;
}

const std::vector<std::pair<std::string, MetadataValue>>& RenderedImage::metadata() const {
  return contents_->header;
}

bool RenderedImage::interrupted() const {
  return contents_->interrupted;
}

std::optional<RenderedImage> RenderedImage::denoised() const {
  if (!contents_->denoiser_failure.empty()) throw DenoiserError(contents_->denoiser_failure);
  if (!contents_->denoised) return std::nullopt;
  return RenderedImage(contents_->denoised);
}

void RenderedImage::save(const std::string& path, const DisplayForm& display,
                         const ExrForm& exr) const {
  check_path(path);
  if (image_format(path).empty())
    throw std::invalid_argument(fmt::format("{}: images are written as .exr, .png or .jpg", path));
  const Image& image = contents_->image;
  if (is_display_format(path) && image.channels[0] != "R")
    throw std::invalid_argument(
        fmt::format("{}: the image has layers only, which .exr files can hold", path));
  const std::vector<uint8_t> bytes =
      image_file_bytes(path, image, contents_->form, contents_->header, settings_of(display, exr));
  try {
    write_file_atomically(path, bytes);
  } catch (const std::runtime_error& e) {
    throw FileError(e.what());
  }
}

std::vector<uint8_t> RenderedImage::png(const DisplayForm& display) const {
  const Image& image = contents_->image;
  if (image.channels[0] != "R")
    throw std::invalid_argument("the image has layers only, no colours to show");
  return image_file_bytes("image.png", image, contents_->form, contents_->header,
                          settings_of(display, {}));
}

}  // namespace duet
