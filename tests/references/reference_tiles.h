// Compares independent images with a reference, tile by tile.
#pragma once

#include <cmath>

#include "image/tile_test.h"
#include "references/cases.h"

namespace duet::test {

/// The comparison of image/tile_test.h with one image whose noise is known. What the reference's
/// three channels have together is at most the noise that they had if they varied as one.
struct ReferenceComparison {
  double mean_z2 = 0, least_p = 1, ratio = 1;
  double ratio_error = 0;  ///< of the images alone
};

inline ReferenceComparison compare_tiles(const TileBatches& images, const Reference& reference) {
  constexpr int n = TileBatches::kTiles;
  std::vector<double> means(n * n), error2(n * n), counts(n * n);
  const size_t stride = reference.mean.channels.size();
  for (int y = 0; y < reference.mean.height; ++y)
    for (int x = 0; x < reference.mean.width; ++x) {
      const auto tile = size_t((y * n / reference.mean.height) * n + x * n / reference.mean.width);
      const size_t pixel = (size_t(y) * size_t(reference.mean.width) + size_t(x)) * stride;
      double deviation = 0;
      for (size_t c = 0; c < 3; ++c) {
        means[tile] += double(reference.mean.data[pixel + c]) / 3;
        deviation += std::sqrt(double(reference.variance.data[pixel + c])) / 3;
      }
      error2[tile] += deviation * deviation / reference.spp;
      ++counts[tile];
    }
  ReferenceComparison r;
  double total = 0;
  for (size_t i = 0; i < means.size(); ++i) {
    // The variance of the reference is known, not estimated.
    const MeanEstimate expected{means[i] / counts[i], error2[i] / (counts[i] * counts[i]), 0};
    total += expected.mean / double(means.size());
    const WelchTest test = welch_test(images.tile(int(i)).estimate(), expected);
    if (!(test.error > 0)) continue;
    const double z = normal_of_student(test.t, test.dof);
    r.mean_z2 += z * z / double(means.size());
    r.least_p = std::min(r.least_p, test.p);
  }
  r.ratio = images.total().mean() / total;
  r.ratio_error = images.total().error() / total;
  return r;
}

}  // namespace duet::test
