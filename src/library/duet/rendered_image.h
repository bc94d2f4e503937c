// Images that were rendered.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace duet {

using MetadataValue = std::variant<std::string, float, int, std::array<float, 16>>;

/// How files for display show radiance.
struct DisplayForm {
  double exposure = 0;              ///< stops
  bool automatic_exposure = false;  ///< the mean of luminance becomes middle grey before that
  std::string tone_map;             ///< "srgb", "aces", "agx", "reinhard"; "": as the scene says
  int png_depth = 8;                ///< bits of a value in PNG files: 8 or 16
};

/// How EXR files hold layers.
struct ExrForm {
  std::string aov_names = "duet";  ///< or "blender", "nuke", "mitsuba" (docs/layers.md)
  bool parts = false;              ///< whether each layer is a part of its own
};

/// Linear values of height × width × channels, float32. It never changes; copies share the pixels.
class [[gnu::visibility("default")]] RenderedImage {
 public:
  /// A copy of height × width × 4 linear values: R, G, B and A, rows from the top.
  static RenderedImage from_rgba(std::span<const float> pixels, int width, int height);

  int width() const;
  int height() const;
  /// "R", "G", "B", "A", if it has colours, then layers such as "depth.T", and mattes, such as
  /// "CryptoObject00.R", an id whose bits are those of the float, and "CryptoObject00.G", its
  /// coverage (docs/layers.md).
  const std::vector<std::string>& channels() const;
  /// Rows from the top, channels interleaved.
  std::span<const float> pixels() const;
  /// What the header of an EXR file says: integrator, spp, seed, relativeStandardError …
  const std::vector<std::pair<std::string, MetadataValue>>& metadata() const;
  /// Whether it was cancelled before it had all samples.
  bool interrupted() const;
  /// What Open Image Denoise makes of it (R, G, B and the same A), if RenderSettings::denoise asked
  /// for it: a guess, biased by an unknown amount, as its metadata say (`denoiser`, `bias`). Throws
  /// DenoiserError if the denoiser has failed.
  std::optional<RenderedImage> denoised() const;

  /// Writes a file as a whole, in the format of the path's extension: .exr (linear, all layers),
  /// .png or .jpg (sRGB, as `display` says). Throws std::invalid_argument for other extensions,
  /// for forms that there are not, for images without colours in formats for display, and if two
  /// channels would have one name; and FileError.
  void save(const std::string& path, const DisplayForm& display = {}, const ExrForm& exr = {})
      const;
  /// The bytes of a PNG file. Throws std::invalid_argument for images without colours and for forms
  /// that there are not.
  std::vector<uint8_t> png(const DisplayForm& display = {}) const;

  /// The library's own.
  struct Contents;
  explicit RenderedImage(std::shared_ptr<const Contents> contents)
      : contents_(std::move(contents)) {}
  const Contents& contents() const {
    return *contents_;
  }

 private:
  std::shared_ptr<const Contents> contents_;
};

}  // namespace duet
