// Comparing images.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <duet/rendered_image.h>

namespace duet {

/// An image in linear values that is compared.
class [[gnu::visibility("default")]] ComparedImage {
 public:
  /// Any image file. Throws FileError.
  static ComparedImage load(const std::string& path);
  /// A copy of height × width × channels values, rows from the top.
  static ComparedImage from_pixels(std::span<const float> pixels, int width, int height,
                                   const std::vector<std::string>& channels);
  /// A copy of a rendered image, with what its metadata say of how it was denoised.
  static ComparedImage from_image(const RenderedImage& image);

  /// The library's own.
  struct Contents;
  const Contents& contents() const {
    return *contents_;
  }

 private:
  explicit ComparedImage(std::shared_ptr<const Contents> contents)
      : contents_(std::move(contents)) {}
  std::shared_ptr<const Contents> contents_;
};

/// By which noise and bias are told apart.
struct ReferenceVariance {
  ComparedImage image;       ///< the variance of one sample of the reference
  double image_spp = 1;      ///< samples per pixel of the image
  double reference_spp = 1;  ///< and of the reference
};

/// The figures, tests and verdict of `duet compare --json`, as the text of a JSON object. `threads`
/// as in RenderSettings. With a variance there is a "warning" if the image was denoised: such are
/// biased. Throws std::invalid_argument for images that cannot be compared.
[[gnu::visibility("default")]] std::string compare_images(
    const ComparedImage& image, const ComparedImage& reference,
    const std::optional<ReferenceVariance>& variance = {}, int threads = 0);

}  // namespace duet
