// Whether two ways to render a scene have the same mean.
// Source: Jung, Hanika & Dachsbacher, "Detecting Bias in Monte Carlo Renderers using Welch's
// t-test", JCGT 9(2), 2020.
#pragma once

#include <vector>

#include "image/image.h"

namespace duet::test {

/// Means of 8×8 tiles of an image's colours, from several independent images.
class TileBatches {
 public:
  static constexpr int kTiles = 8;
  void add(const Image& image);
  size_t count() const { return batches_.size(); }
  double mean(int tile) const;
  /// Squared standard error of the mean.
  double error2(int tile) const;
  /// Over the whole image.
  double total() const;

 private:
  std::vector<std::vector<double>> batches_;
};

struct TileComparison {
  double mean_z2 = 0;      ///< about 1 if the means are equal
  double least_p = 1;      ///< of the 64 tiles, by Welch's test
  double ratio = 1;        ///< of the images' means
  double worst_ratio = 1;  ///< of a tile, the one furthest from 1
  int tiles = 0;           ///< that have any variance
};
TileComparison compare_tiles(const TileBatches& a, const TileBatches& b);

/// Tiles of a mean image of `spp` samples per pixel, whose errors follow from the variance of one
/// sample. That of the three channels together is at most what they had if they varied as one.
struct ReferenceTiles {
  ReferenceTiles(const Image& mean, const Image& variance, double spp);
  std::vector<double> means, error2;
};
/// The same against images whose noise is known.
TileComparison compare_tiles(const TileBatches& a, const ReferenceTiles& b);

}  // namespace duet::test
