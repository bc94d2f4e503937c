#include "app/output.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "app/commands.h"

namespace duet {

namespace fs = std::filesystem;

namespace {

std::string extension_of(const std::string& path) {
  std::string e = fs::path(path).extension().string();
  std::transform(e.begin(), e.end(), e.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return e;
}

bool is_directory(const std::string& path) {
  std::error_code ignored;
  return path.ends_with('/') || fs::is_directory(path, ignored);
}

std::string fill_in(const std::string& pattern, const OutputNames& names) {
  std::string out;
  for (size_t i = 0; i < pattern.size(); ++i) {
    if (pattern[i] != '{') {
      out += pattern[i];
      continue;
    }
    const size_t end = pattern.find('}', i);
    const std::string key = end == std::string::npos ? "" : pattern.substr(i + 1, end - i - 1);
    if (key == "scene")
      out += names.scene;
    else if (key == "integrator")
      out += names.integrator;
    else if (key == "spp")
      out += fmt::to_string(names.spp);
    else if (key == "seed")
      out += fmt::to_string(names.seed);
    else
      throw UsageError(fmt::format(
          "-o {}: only {{scene}}, {{integrator}}, {{spp}} and {{seed}} are filled in", pattern));
    i = end;
  }
  return out;
}

/// Reinhard et al., "Photographic Tone Reproduction for Digital Images", 2002, eqs. 1 to 4, applied
/// to luminance: `key` is the middle grey; `burn` from 0 to 1 lowers the luminance that becomes
/// white by the square of 1 − burn, as Mitsuba 0.6 does.
class Reinhard {
 public:
  Reinhard(const Image& image, double key, double burn) {
    double log_sum = 0, brightest = 0;
    const size_t n = size_t(image.width) * image.height;
    for (size_t i = 0; i < n; ++i) {
      const double y = std::max(0.0, double(luminance(&image.data[i * image.channels.size()])));
      log_sum += std::log(1e-3 + y);
      brightest = std::max(brightest, y);
    }
    scale_ = key / std::exp(log_sum / double(n));
    const double white = brightest * scale_ * std::pow(std::clamp(1 - burn, 1e-8, 1.0), 2);
    inverse_white2_ = white > 0 ? 1 / (white * white) : 0;
  }
  double factor(const float* rgb) const {
    const double y = std::max(0.0, double(luminance(rgb))) * scale_;
    return scale_ * (1 + y * inverse_white2_) / (1 + y);
  }

 private:
  static float luminance(const float* rgb) { return Spectrum(rgb[0], rgb[1], rgb[2]).luminance(); }
  double scale_, inverse_white2_;
};

}  // namespace

bool is_fixed_file(const std::string& pattern) {
  return !pattern.empty() && !is_directory(pattern) && pattern.find("{scene}") == std::string::npos;
}

std::string output_path(const std::string& pattern, const OutputNames& names) {
  std::string path = fill_in(pattern, names);
  if (path.empty())
    path = names.scene + ".exr";
  else if (is_directory(path))
    path = (fs::path(path) / (names.scene + ".exr")).string();
  const std::string e = extension_of(path);
  if (e != ".exr" && e != ".png" && e != ".jpg" && e != ".jpeg")
    throw UsageError(fmt::format("-o {}: images are written as .exr, .png or .jpg", path));
  return path;
}

std::string unwritable_reason(const std::string& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) return "it is a directory";
  const fs::path parent = fs::path(path).has_parent_path() ? fs::path(path).parent_path() : ".";
  if (!fs::is_directory(parent, ignored))
    return fmt::format("there is no directory \"{}\"", parent.string());
  if (access(parent.c_str(), W_OK) != 0)
    return fmt::format("the directory \"{}\" is not writable", parent.string());
  return "";
}

std::vector<uint8_t> to_display(const Image& image, const DisplayOptions& options,
                                bool with_alpha) {
  const ToneMapping tone = options.tone_mapping.value_or(ToneMapping{});
  const size_t n = size_t(image.width) * image.height, stride = image.channels.size();
  const int channels = with_alpha ? 4 : 3;
  const double scale = std::exp2(options.exposure + (tone.reinhard ? 0 : tone.exposure));
  std::optional<Reinhard> reinhard;
  if (tone.reinhard) reinhard.emplace(image, tone.key, tone.burn);
  const auto encode = [&](double v) {
    if (!(v > 0)) return uint8_t(0);
    v = std::min(v, 1.0);
    const double e = tone.gamma > 0 ? std::pow(v, 1 / tone.gamma) : linear_to_srgb(float(v));
    return uint8_t(std::lround(255 * std::clamp(e, 0.0, 1.0)));
  };
  std::vector<uint8_t> bytes(n * channels);
  for (size_t i = 0; i < n; ++i) {
    const float* p = &image.data[i * stride];
    const double s = scale * (reinhard ? reinhard->factor(p) : 1.0);
    for (int c = 0; c < 3; ++c) bytes[i * channels + c] = encode(p[c] * s);
    if (with_alpha)
      bytes[i * channels + 3] = uint8_t(std::lround(255 * std::clamp(double(p[3]), 0.0, 1.0)));
  }
  return bytes;
}

Image in_pixel_format(const Image& image, PixelFormat format) {
  if (image.channels.size() < 4 || image.channels[0] != "R") return image;
  const bool with_alpha = format == PixelFormat::rgba || format == PixelFormat::xyza ||
                          format == PixelFormat::luminance_alpha;
  std::vector<std::string> names{"R", "G", "B"};
  if (format == PixelFormat::luminance || format == PixelFormat::luminance_alpha) names = {"Y"};
  if (format == PixelFormat::xyz || format == PixelFormat::xyza) names = {"X", "Y", "Z"};
  const size_t colours = names.size();
  if (with_alpha) names.push_back("A");
  names.insert(names.end(), image.channels.begin() + 4, image.channels.end());
  Image out(image.width, image.height, names);
  const size_t from_stride = image.channels.size(), to_stride = names.size();
  for (size_t i = 0; i < size_t(image.width) * image.height; ++i) {
    const float* p = &image.data[i * from_stride];
    float* q = &out.data[i * to_stride];
    const Spectrum rgb(p[0], p[1], p[2]);
    if (colours == 1) {
      *q++ = rgb.luminance();
    } else if (names[0] == "X") {
      *q++ = 0.412453f * rgb.r + 0.357580f * rgb.g + 0.180423f * rgb.b;
      *q++ = rgb.luminance();
      *q++ = 0.019334f * rgb.r + 0.119193f * rgb.g + 0.950227f * rgb.b;
    } else {
      for (int c = 0; c < 3; ++c) *q++ = rgb[c];
    }
    if (with_alpha) *q++ = p[3];
    std::copy(p + 4, p + from_stride, q);
  }
  return out;
}

void write_image(const std::string& path, const Image& image, const ExrOptions& exr,
                 const DisplayOptions& display) {
  const auto write = [&](const std::string& to) {
    const std::string e = extension_of(to);
    if (e == ".exr") return write_exr(to, image, exr);
    if (image.channels[0] != "R")
      throw std::runtime_error("only colours can be written in this format; use .exr");
    const bool with_alpha = e == ".png" && image.find_channel("A") == 3;
    write_display_image(to, image.width, image.height, with_alpha ? 4 : 3,
                        to_display(image, display, with_alpha));
  };
  try {
    write(path);
  } catch (const std::exception& failure) {
    const std::string rescue =
        (fs::temp_directory_path() /
         fmt::format("duet-{}-{}.exr", fs::path(path).stem().string(), getpid()))
            .string();
    std::string outcome;
    try {
      write_exr(rescue, image, exr);
      outcome = fmt::format("; the image is saved as {}", rescue);
    } catch (const std::exception& second) {
      outcome = fmt::format("; nor could it be saved as {}: {}", rescue, second.what());
    }
    throw std::runtime_error(fmt::format("cannot write {}: {}{}", path, failure.what(), outcome));
  }
}

}  // namespace duet
