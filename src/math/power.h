// How small a difference a test would have noticed.
#pragma once

#include <functional>

namespace duet {

/// The probability with which a difference of the size that is stated is noticed.
inline constexpr double kPowerShare = 0.95;

/// The difference of two means that Welch's two-sided test of this level notices with probability
/// kPowerShare. `error` is the standard error of the difference, in the unit of the means, `dof`
/// its degrees of freedom; 0 without any error. Source: the normal approximation of the noncentral
/// t-distribution, Johnson & Welch, "Applications of the non-central t-distribution", Biometrika
/// 31, 1940.
double noticed_difference(double error, double dof, double level);

/// By how much the true value of a statistic has to be beyond a fixed limit for an estimate of this
/// standard error to be beyond it, too, with probability kPowerShare.
double noticed_excess(double error, double dof);

/// A standard error by the jackknife: `value(g)` is the statistic without the g-th of `groups`
/// groups of data, at least 2. Source: Efron, "The Jackknife, the Bootstrap and Other Resampling
/// Plans", 1982.
double jackknife_error(int groups, const std::function<double(int)>& value);

}  // namespace duet
