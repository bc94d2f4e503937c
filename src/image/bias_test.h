// Whether noise explains how one image differs from a reference: a test with a known rate of false
// alarms (docs/compare.md).
//
// The difference of the means of every tile and of the whole image is held against two standard
// errors, and the larger p-value counts: one from the variance of the reference's samples, which
// knows of light that few samples carry even where the image has missed it; and one from the spread
// of the differences within the tile, to which a single outlier adds as much as it adds to the
// mean.
#pragma once

#include <array>

#include "image/metrics.h"

namespace duet {

/// Probability that an image without bias is called biased, at most.
inline constexpr double kBiasSignificance = 0.01;

/// The difference of a part of the image that is least compatible with noise.
struct RegionTest {
  int x = 0, y = 0, width = 0, height = 0;  ///< in pixels of the image
  int channel = 0;                          ///< 0 R, 1 G, 2 B
  double p = 1;                             ///< of this test alone
  double ratio = 1;                         ///< of the means there, image over reference
};

struct BiasTest {
  double p = 1;     ///< of the comparison: that the least p of all tests is as small by chance
  int tests = 0;    ///< tiles and whole images, times three channels; 0 if all pixels are left out
  RegionTest tile;  ///< of the tiles
  RegionTest mean;  ///< of the whole image, each tile weighted alike or by its certainty
  /// Ratio of the means over all pixels and its standard error, per channel.
  std::array<double, 3> ratio{1, 1, 1}, ratio_error{};
  /// The relative bias that would have been noticed with a probability of 80 %: of the whole image,
  /// of the middle one of the tiles that are not next to black, and of the least certain of them.
  double noticed_mean = 0, noticed_tile = 0, noticed_tile_worst = 0;
  /// By how much pixels that share samples raise the variance of sums, 1 if they share none.
  double correlation = 1;
  long left_out = 0;  ///< pixels that are not finite or whose variance is not known
  bool biased() const { return p < kBiasSignificance; }
  /// The largest relative difference of a channel's mean that the image leaves possible with 95 %.
  double bound95() const;
};

/// The image, the reference and the variance have equal sizes and channels R, G, B or Y; throws
/// std::invalid_argument otherwise. There are 8×8 tiles, or fewer of at least 4×4 pixels.
BiasTest test_bias(const Image& image, const Image& reference, const NoiseModel& noise);

}  // namespace duet
