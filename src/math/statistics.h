// Statistics of measurements: means with their errors, and whether two means agree.
#pragma once

#include <cmath>
#include <cstdint>

namespace duet {

/// Probability that a normal variate is further from zero than |z|.
double normal_p_value(double z);
/// The |z| that a normal variate exceeds with this probability, 0 < p < 1.
double normal_quantile(double p);
/// The level of each of n independent tests so that all of them together have level `alpha`.
double sidak(double alpha, int n);

/// The normal variate that is as improbable as Student's t with `dof` degrees of freedom.
/// Source: Wallace, "Bounds on Normal Approximations to Student's and the Chi-Square
/// Distributions", Annals of Mathematical Statistics 30, 1959, eq. 2.1 and the correction that
/// follows it; at most 1 % below z from 5 degrees of freedom on.
double normal_of_student(double t, double dof);
/// Its inverse: the t that is as improbable as z.
double student_of_normal(double z, double dof);

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

/// Welch's test of whether the means of two groups of measurements are equal, which may have
/// different variances.
struct WelchTest {
  double t = 0;      ///< difference of the means over its standard error
  double error = 0;  ///< that standard error
  double dof = 1;    ///< Welch & Satterthwaite's degrees of freedom
  double p = 1;      ///< probability of a larger |t| if the means are equal
};
/// Each group needs two measurements. Groups without any variance are equal (p is 1) or not (p is
/// 0).
WelchTest welch_test(const Moments& a, const Moments& b);

}  // namespace duet
