// How alike two images are as a display shows them: PSNR and SSIM.
// Source: Wang, Bovik, Sheikh, Simoncelli, "Image Quality Assessment: From Error Visibility to
// Structural Similarity", IEEE Transactions on Image Processing 13(4), 2004.
#pragma once

#include <optional>

#include "image/image.h"

namespace duet {

/// Side of the windows of SSIM, in pixels.
inline constexpr int kSsimWindow = 11;

/// Of values as a display shows them: linear ones are cut to [0, 1] and encoded as sRGB, so that
/// the peak is 1. What is not a number counts as 0.
struct DisplayMetrics {
  /// 10 log10(1 / mean of (a − b)²) over channels and pixels, in decibels; infinite if all are
  /// equal.
  double psnr = 0;
  /// Mean structural similarity, 1 for equal images, of the channels' windows of 11×11 pixels that
  /// lie within the image, weighted by a Gaussian of 1.5 pixels, with K1 = 0.01 and K2 = 0.03.
  /// Empty if the image is smaller than a window.
  std::optional<double> ssim;
};

/// Both images have linear values. Throws std::invalid_argument if the sizes differ or colours are
/// missing.
DisplayMetrics display_metrics(const Image& image, const Image& reference);

}  // namespace duet
