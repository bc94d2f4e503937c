// How far an image is from the truth, when the reference has noise of its own.
#pragma once

#include <optional>
#include <vector>

#include "image/image.h"

namespace duet {

/// Errors as in ImageMetrics, squared ones with the variance of the reference subtracted: what is
/// left may come out below zero where the image is as good as the reference.
struct ReferenceErrors {
  double mse = 0, relmse = 0, trimmed = 0;
  double firefly = 0;
  /// The trimmed sum of each of 8×8 tiles and the number of pixels it is over.
  std::vector<double> tile_sums, tile_pixels;
};

/// A reference to which many images are compared.
class NoisyReference {
 public:
  static constexpr int kTiles = 8;
  /// `variance` is that of the reference's pixels (not of one sample), null for a reference without
  /// noise. Throws std::invalid_argument for sizes that differ, missing colours and values that are
  /// not finite.
  NoisyReference(const Image& mean, const Image* variance);

  int width() const { return width_; }
  int height() const { return height_; }
  /// Throws std::invalid_argument for another size or missing colours. Pixels that are not finite
  /// count as black.
  ReferenceErrors errors(const Image& image) const;
  /// What `trimmed` would be of another image with exactly this reference's noise.
  double noise() const { return noise_; }

 private:
  int width_, height_;
  std::vector<double> mean_;      ///< three per pixel
  std::vector<double> variance_;  ///< three per pixel, or empty
  double noise_ = 0;
};

}  // namespace duet
