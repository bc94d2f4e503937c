// Statistical tests: whether samples follow a density, whether two means agree.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "math/vector.h"

namespace duet::test {

/// Regularised upper incomplete gamma function Q(a, x).
double gamma_q(double a, double x);
/// Probability that a χ² variate with `dof` degrees of freedom exceeds `statistic`.
double chi2_p_value(double statistic, int dof);
/// Probability that a normal variate is further from zero than |z|.
double normal_p_value(double z);
/// The level of each of n independent tests so that all of them together have level `alpha`.
double sidak(double alpha, int n);

/// Outcome of a χ² test. `pass` is false also if samples fell where the density is zero.
struct Chi2Result {
  bool pass = false;
  double p_value = 0, statistic = 0;
  int dof = 0;
  std::string message;
};

/// Pearson's test of observed counts against expected ones. Cells that expect less than five are
/// pooled. `level` is the probability of rejecting a correct sampler.
Chi2Result chi2_test(const std::vector<double>& observed, const std::vector<double>& expected,
                     double level);

/// Tests samples on the unit square against a density that integrates to `mass` ≤ 1 (the rest are
/// failed samples). `sample` fills a position and returns false if it failed; `density` is
/// integrated over each of nx × ny cells by the midpoint rule on sub × sub points.
struct SquareTest {
  int nx = 40, ny = 20, sub = 8;
  int samples = 400000;
  double level = 0.01;
  uint64_t seed = 1;
};
Chi2Result chi2_square(const std::function<bool(Point2f u, Point2f& position)>& sample,
                       const std::function<double(Point2f)>& density,
                       const SquareTest& options = {});

/// The same for unit directions and a density per solid angle, over cells of (φ, cos θ).
/// `sample` receives three uniform numbers.
Chi2Result chi2_sphere(const std::function<bool(float u, Point2f v, Vector3f& direction)>& sample,
                       const std::function<double(const Vector3f&)>& density,
                       const SquareTest& options = {});

/// Running mean and variance.
class Moments {
 public:
  void add(double x) {
    ++n_;
    const double d = x - mean_;
    mean_ += d / double(n_);
    m2_ += d * (x - mean_);
  }
  double mean() const { return mean_; }
  double variance() const { return n_ > 1 ? m2_ / double(n_ - 1) : 0; }
  /// Standard error of the mean.
  double error() const { return n_ > 1 ? std::sqrt(variance() / double(n_)) : 0; }
  int64_t count() const { return n_; }

 private:
  int64_t n_ = 0;
  double mean_ = 0, m2_ = 0;
};

}  // namespace duet::test
