// How far a rendered image may be from its limit, judged from the spread of its parts.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "image/film.h"

namespace duet {

/// The standard error of the mean of several independent films (of equally many samples each), as a
/// root mean square over all pixels of the channels R, G and B, relative to the mean of the image.
/// Empty if the image is black or has no colours.
std::optional<double> batch_relative_rmse(const std::vector<Film>& films, int threads = 1);

/// Sum of estimates of the variance of one sample, and how many they are.
struct VarianceSum {
  double squares = 0, count = 0;
};

/// The same from the consecutive parts of one film. Two parts in succession differ by the noise of
/// both, so the mean square of their differences estimates the variance of a sample. If the parts
/// belong to one low-discrepancy sequence the result is an upper bound.
class PartialMeans {
 public:
  explicit PartialMeans(const Film& film);
  /// Bytes that it takes for a film of so many pixels.
  static double memory_bytes(double pixels, bool has_splats) {
    return pixels * double(sizeof(Sums) + sizeof(Pixel) + (has_splats ? 3 * sizeof(double) : 0));
  }
  /// Takes note of what has been added to the film since the last call.
  void add_part(const Film& film, int threads = 1);
  std::optional<double> relative_rmse() const;
  const VarianceSum& variance() const { return variance_; }
  /// Instead of what the parts so far tell: that of other films, too.
  void set_variance(const VarianceSum& variance) { variance_ = variance; }

 private:
  struct Pixel {
    float mean[3];
    float weight;  ///< of the samples in the part
  };
  /// Of a pixel: the weight, and the weighted colours.
  using Sums = std::array<double, 4>;
  /// Of the pixels of a tile.
  struct TileSums {
    VarianceSum variance;
    double total = 0, weight = 0, pixels = 0;
  };

  TileSums add_tile(const Film& film, size_t tile);
  /// The mean that the splats of this part alone add to a channel of a pixel; `mean` becomes that
  /// of all so far.
  double splats_of_part(const Film& film, int x, int y, int c, double& mean);

  std::vector<std::vector<Sums>> before_;  ///< at the last call, of each tile's own pixels
  std::vector<std::vector<Pixel>> last_;   ///< the last part's means, of the same pixels
  std::vector<double> splats_before_;      ///< means of the splats, if the film has any
  double passes_before_ = 0;
  int parts_ = 0;
  int channels_ = 0;
  VarianceSum variance_;
  double total_ = 0, weight_ = 0, pixels_ = 0;  ///< for the mean of the image and of its samples
};

}  // namespace duet
