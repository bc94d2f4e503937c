#include "app/output.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "app/commands.h"
#include "app/placeholders.h"
#include "app/scene_operand.h"
#include "app/standard_output.h"
#include "base/atomic_file.h"

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

bool has_alpha(PixelFormat f) {
  return f == PixelFormat::rgba || f == PixelFormat::xyza || f == PixelFormat::luminance_alpha;
}
bool is_grey(PixelFormat f) {
  return f == PixelFormat::luminance || f == PixelFormat::luminance_alpha;
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

OutputNames output_names(const std::string& scene_file) {
  std::error_code ignored;
  const bool is_stdin = scene_file == kStandardInput;
  fs::path path = fs::absolute(is_stdin ? "stdin.xml" : scene_file, ignored).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();  // a directory without a scene
  const std::string folder = path.parent_path().filename().string();
  const bool says_nothing = path.filename() == "scene.xml" && !folder.empty();
  return {says_nothing ? folder : path.stem().string(), folder, "", "", ""};
}

bool is_display_format(const std::string& path) {
  const std::string format = image_format(path);
  return format == "png" || format == "jpg";
}

std::string image_format(const std::string& path) {
  const std::string e = extension_of(path);
  if (e == ".exr" || e == ".png" || e == ".jpg") return e.substr(1);
  return e == ".jpeg" ? "jpg" : "";
}

std::string output_path(const std::string& pattern, const OutputNames& names,
                        const std::string& extension) {
  if (pattern == "-") return kStandardOutput + extension;
  std::string path = fill_in("-o", pattern,
                             {{"scene", names.scene},
                              {"folder", names.folder},
                              {"integrator", names.integrator},
                              {"spp", names.spp},
                              {"seed", names.seed}});
  if (path.empty())
    path = names.scene + extension;
  else if (is_directory(path))
    path = (fs::path(path) / (names.scene + extension)).string();
  if (image_format(path).empty())
    throw UsageError(fmt::format(
        "-o {}: images are written as .exr, .png or .jpg; the name of a new directory ends with /",
        path));
  return path;
}

bool make_directories(const fs::path& directory, std::error_code& error) {
  if (directory.empty()) return true;
  // A slash at the end would make it an error that the directory is there.
  fs::create_directories(directory.has_filename() ? directory : directory.parent_path(), error);
  std::error_code ignored;
  return fs::is_directory(directory, ignored);
}

std::string prepare_file(const std::string& path) {
  if (is_standard_output(path)) return standard_output_refusal();
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) return "it is a directory";
  if (fs::exists(status) && !fs::is_regular_file(status)) return "it is not a regular file";
  const fs::path parent = fs::path(path).has_parent_path() ? fs::path(path).parent_path() : ".";
  if (!make_directories(parent, error))
    return fmt::format("the directory \"{}\" cannot be made: {}", parent.string(), error.message());
  if (access(parent.c_str(), W_OK) != 0)
    return fmt::format("the directory \"{}\" is not writable", parent.string());
  return "";
}

DisplayImage to_display(const Image& image, const DisplayOptions& options, bool grey,
                        bool with_alpha) {
  const ToneMapping tone = options.tone_mapping.value_or(ToneMapping{});
  const size_t n = size_t(image.width) * image.height, stride = image.channels.size();
  const double scale = std::exp2(options.exposure + (tone.reinhard ? 0 : tone.exposure));
  std::optional<Reinhard> reinhard;
  if (tone.reinhard) reinhard.emplace(image, tone.key, tone.burn);
  const auto byte = [](double v) { return uint8_t(std::lround(255 * std::clamp(v, 0.0, 1.0))); };
  const auto encode = [&](double v) {
    if (!(v > 0)) return uint8_t(0);
    v = std::min(v, 1.0);
    return byte(tone.gamma > 0 ? std::pow(v, 1 / tone.gamma) : linear_to_srgb(float(v)));
  };
  DisplayImage out;
  out.channels = (grey ? 1 : 3) + with_alpha;
  out.bytes.reserve(n * size_t(out.channels));
  for (size_t i = 0; i < n; ++i) {
    const float* p = &image.data[i * stride];
    double s = scale * (reinhard ? reinhard->factor(p) : 1.0);
    if (with_alpha && p[3] > 0) s /= p[3];
    if (grey)
      out.bytes.push_back(encode(Spectrum(p[0], p[1], p[2]).luminance() * s));
    else
      for (int c = 0; c < 3; ++c) out.bytes.push_back(encode(p[c] * s));
    if (with_alpha) out.bytes.push_back(byte(p[3]));
  }
  return out;
}

Image in_pixel_format(const Image& image, PixelFormat format) {
  if (image.channels[0] != "R") return image;
  const bool with_alpha = has_alpha(format);
  std::vector<std::string> names{"R", "G", "B"};
  if (is_grey(format)) names = {"Y"};
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

void write_image(const std::string& path, const Image& image, PixelFormat format,
                 const ExrOptions& exr, const DisplayOptions& display) {
  const auto encode = [&](const std::string& to) {
    if (!is_display_format(to)) return exr_bytes(to, in_pixel_format(image, format), exr);
    const bool with_alpha = has_alpha(format) && extension_of(to) == ".png";
    const DisplayImage shown = to_display(image, display, is_grey(format), with_alpha);
    return display_image_bytes(to, image.width, image.height, shown.channels, shown.bytes,
                               display.fields);
  };
  const auto write = [&](const std::string& to) {
    const std::vector<uint8_t> bytes = encode(to);
    if (is_standard_output(to)) return write_standard_output(bytes);
    // The number of samples may be part of its name, and is known only now.
    std::error_code ignored;
    make_directories(fs::path(to).parent_path(), ignored);
    write_file_atomically(to, bytes);
  };
  try {
    write(path);
  } catch (const std::exception& failure) {
    std::error_code ignored;
    fs::path folder = fs::temp_directory_path(ignored);
    if (folder.empty()) folder = "/tmp";
    // Scenes of one call may have the same name.
    static std::atomic<int> counter = 0;
    const std::string rescue =
        (folder / fmt::format("duet-{}-{}-{}.exr",
                              is_standard_output(path) ? "stdout" : fs::path(path).stem().string(),
                              getpid(), counter++))
            .string();
    std::string outcome;
    try {
      write(rescue);
      outcome = fmt::format("; the image is saved as {}", rescue);
    } catch (const std::exception& second) {
      outcome = fmt::format("; nor could it be saved as {}: {}", rescue, second.what());
    }
    throw std::runtime_error(std::string(failure.what()) + outcome);
  }
}

}  // namespace duet
