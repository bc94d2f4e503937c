// Images of groups of pixels held against those of single ones.
#pragma once

#include <functional>

#include "integrators/batch_cases.h"

namespace duet::test {

/// An image with so many members in a group.
using RenderGroup = std::function<Image(int members, const RenderRequest& r)>;

/// How often the difference of means is larger than its error: of the same paths, so that most of
/// their noise is in both.
struct Differences {
  double worst = 0;  ///< of a tile, in standard errors
  double mean = 0;   ///< of the image, relative
  double error = 0;  ///< of that
};
/// Of groups and single pixels.
Differences compare_means(const RenderGroup& render, int members);

/// The same pixel by pixel.
struct PixelDifferences {
  double z2 = 0;     ///< mean squared difference, in standard errors
  double error = 0;  ///< root of the mean squared standard error, relative to the mean
};
PixelDifferences compare_pixels(const RenderGroup& render, int members, int samples);

/// The median squared difference of two images.
double median_noise(const RenderGroup& render, int members);

/// Checks that an image is the same bit for bit on any number of threads, in passes and in a window
/// of it.
void check_bits(const RenderGroup& render, TransportScene& scene);

}  // namespace duet::test
