// Whether two ways to render a scene have the same mean, told from several images of each.
// Source: Jung, Hanika & Dachsbacher, "Detecting Bias in Monte Carlo Renderers using Welch's
// t-test", JCGT 9(2), 2020.
#pragma once

#include <array>
#include <vector>

#include "image/image.h"
#include "math/statistics.h"

namespace duet {

/// The means of 8×8 tiles of an image's colours, over several independent images.
class TileBatches {
 public:
  static constexpr int kTiles = 8;
  /// The image needs channels R, G, B, or Y; throws std::invalid_argument without them, for an
  /// image of another size than the first, and for one that is smaller than the tiles.
  void add(const Image& image);
  size_t count() const { return count_; }
  const Moments& tile(int i) const { return tiles_[size_t(i)]; }
  /// The mean over the whole image.
  const Moments& total() const { return total_; }
  using Means = std::array<double, size_t(kTiles) * kTiles>;
  /// The tiles of each image.
  const std::vector<Means>& images() const { return images_; }

 private:
  size_t count_ = 0;
  int width_ = 0, height_ = 0;
  std::vector<Moments> tiles_ = std::vector<Moments>(kTiles * kTiles);
  Moments total_;
  std::vector<Means> images_;
};

/// Significance of the test as a whole: the probability of rejecting what is equal.
inline constexpr double kTileSignificance = 0.01;
struct TileComparison {
  /// Of the comparison: that chance makes the least of `tile_p`, `z2_p` and `mean_p` as small.
  double p = 1;
  int tiles = 0;     ///< that have any variance, or differ without it
  int rejected = 0;  ///< of them, at significance 0.01, Šidák-corrected for their number
  /// Mean square of the tiles' differences as normal variates: about 1 if the means are equal.
  double mean_z2 = 0;
  double least_p = 1;      ///< of all tiles, by Welch's test
  double tile_p = 1;       ///< that chance makes least_p as small
  double z2_p = 1;         ///< that chance makes mean_z2 as large
  double mean_p = 1;       ///< of the whole images' means, by Welch's test
  double ratio = 1;        ///< of the images' means
  double ratio_error = 0;  ///< standard error of that ratio
  double worst_ratio = 1;  ///< of a tile, the one furthest from 1
  /// The relative bias of a tile that the test would have noticed with a probability of 80 %: in
  /// the middle one of the tiles, and in the least certain one.
  double visible_bias = 0, visible_bias_worst = 0;
  /// Whether the test finds the means equal.
  bool equal() const { return p >= kTileSignificance; }
};
/// Both sides need at least two images, of equal sizes; throws std::invalid_argument otherwise.
TileComparison compare_tiles(const TileBatches& a, const TileBatches& b);

}  // namespace duet
