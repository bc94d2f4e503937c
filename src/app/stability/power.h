// How small a deviation a measurement of the stability table would have noticed.
#pragma once

#include <functional>

#include "math/statistics.h"

namespace duet::stability {

/// The probability with which a deviation of the size that is stated is noticed.
inline constexpr double kPowerShare = 0.95;
/// A "holds" counts only if a deviation of a tile (or of a pixel, in rows that look at pixels) by
/// this share of its mean would have been noticed, or one of an image's mean by the other; of
/// methods that may be off by a margin, one of twice the margin.
inline constexpr double kTileResolution = 0.05, kMeanResolution = 0.01;
/// By how much coarser the bounds of the short run are.
inline constexpr double kFastFactor = 5;

/// What a measurement would have noticed, in the unit of its check.
struct Power {
  double noticed = 0;   ///< with 95 % probability
  double required = 0;  ///< the bound for `noticed` without which "holds" says nothing
  /// Noise over the greatest noise that meets the bound: squared, the factor by which samples have
  /// to grow. 0 where there is no noise.
  double noise = 0;
  bool resolved() const { return noise <= 1; }
};

/// The less powerful of two.
inline const Power& weaker(const Power& a, const Power& b) {
  return b.noise > a.noise ? b : a;
}

/// The difference of two means that Welch's test of this level notices with 95 % probability;
/// `error` is the standard error of the difference. Source: the normal approximation of the
/// noncentral t-distribution, Johnson & Welch, "Applications of the non-central t-distribution",
/// Biometrika 31, 1940.
double noticed_difference(double error, double dof, double level);

/// The power of a comparison with a fixed limit. `slack` is by how much worse than the limit a true
/// value has to be to be noticed: positive where low values are good. `error` is the standard error
/// of the statistic with `dof` degrees of freedom.
Power limit_power(double limit, double slack, double error, double dof);

/// A standard error by the jackknife: `value(g)` is the statistic without the g-th of `groups`
/// groups of images. Source: Efron, "The Jackknife, the Bootstrap and Other Resampling Plans", 1982.
double jackknife_error(int groups, const std::function<double(int)>& value);

/// Calls `noise` with growing numbers of images, from `first` on and at most `most`, until the
/// noise (as in Power) that it returns is at most 1.
void grow_images(int first, int most, const std::function<double(int)>& noise);

}  // namespace duet::stability
