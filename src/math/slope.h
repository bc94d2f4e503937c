// How fast an error falls: the slope of a curve on logarithmic axes, with its uncertainty.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace duet {

struct Interval {
  double low = 0, high = 0;
};

/// A point of the curve, as sums over parts (say, tiles of an image) that are about independent of
/// one another. Its value is the sum over all parts of `sums` over that of `weights`.
struct CurvePoint {
  double x = 0;  ///< above 0
  std::vector<double> sums, weights;
  double value() const;
};

struct Line {
  double slope = 0, intercept = 0;
};
/// The weighted least-squares line y = slope · x + intercept. Needs two different x with weight.
Line fit_line(const std::vector<double>& x, const std::vector<double>& y,
              const std::vector<double>& weights);

struct SlopeFit {
  /// Of the square root of the value over x, both as logarithms: −1/2 for independent samples.
  double slope = 0;
  Interval slope_95;
  double intercept = 0;  ///< natural logarithm of that root at x = 1
};

/// A curve with confidence intervals. Points of one render share its samples, so that scatter
/// around the line says little; instead parts are drawn with replacement (Efron's bootstrap), each
/// with all its points, and everything is computed again.
struct CurveFit {
  std::vector<Interval> value_95;  ///< of each point
  /// Empty with less than three points above zero (its interval, too), or if x spans less than a
  /// factor of four. Points are weighted with the inverse variance of their logarithms.
  std::optional<SlopeFit> slope;
};
/// All points have equally many parts. The result depends on the input alone.
CurveFit fit_curve(const std::vector<CurvePoint>& points);

}  // namespace duet
