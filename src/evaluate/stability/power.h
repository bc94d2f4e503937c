// Whether a measurement of the stability table could have come out otherwise: how small a deviation
// it would have noticed, and had to.
#pragma once

#include <functional>

#include "math/power.h"

namespace duet::stability {

/// A "holds" counts only if a deviation of a tile (or of a pixel, in rows that look at pixels) by
/// this share of its mean would have been noticed, or one of an image's mean by the other; of
/// methods that may be off by a margin, one of twice the margin.
inline constexpr double kTileResolution = 0.05, kMeanResolution = 0.01;
/// By how much coarser the bounds of the short run are.
inline constexpr double kFastFactor = 5;

/// What a measurement would have noticed, in the unit of its check.
struct Power {
  double noticed = 0;   ///< with probability kPowerShare
  double required = 0;  ///< the bound for `noticed` without which "holds" says nothing
  /// Noise over the greatest noise that meets the bound: squared, the factor by which the number of
  /// images has to grow. 0 where there is no noise.
  double noise = 0;
  bool resolved() const { return noise <= 1; }
};

/// The less powerful of two.
inline const Power& weaker(const Power& a, const Power& b) {
  return b.noise > a.noise ? b : a;
}

/// The power of a comparison with a fixed limit. `slack` is by how much worse than the limit a true
/// value has to be to be noticed: positive where low values are good. `error` is the standard error
/// of the statistic with `dof` degrees of freedom.
Power limit_power(double limit, double slack, double error, double dof);

/// Calls `noise` with growing numbers of images, from `first` on and at most `most`, until the
/// noise (as in Power) that it returns is at most 1.
void grow_images(int first, int most, const std::function<double(int)>& noise);

}  // namespace duet::stability
