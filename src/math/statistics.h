// Statistics of measurements: means with their errors, and whether means agree.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>

namespace duet {

/// Probability that a normal variate is further from zero than |z|.
double normal_p_value(double z);
/// The |z| that a normal variate exceeds with this probability, 0 < p < 1.
double normal_quantile(double p);
/// Probability that a variate of Student's distribution is further from zero than |t|; the normal
/// distribution's if dof is infinite.
/// Source: Abramowitz & Stegun, 26.7.1, by the incomplete beta function.
double student_p_value(double t, double dof);
/// The |normal variate| that is as improbable as Student's t; at most 40.
double normal_of_student(double t, double dof);
/// Its inverse: the |t| that is as improbable as z.
double student_of_normal(double z, double dof);
/// Probability that a variate of the chi-square distribution is above x; dof is any number above 0.
/// Source: Abramowitz & Stegun, 6.5.29 and 6.5.31.
double chi_square_p_value(double x, double dof);
/// The level of each of `tests` independent tests so that all of them together have level `alpha`.
/// Source: Sidak, "Rectangular confidence regions …", JASA 62, 1967.
double sidak(double alpha, double tests);
/// Its inverse: the p-value of all of `tests` tests together of which the least p-value is p.
double sidak_p_value(double p, double tests);

/// The mean of independent values and the square of its standard error; a value that is known
/// exactly has an error of zero.
struct MeanEstimate {
  double mean = 0, error2 = 0;
  int64_t count = 0;
};

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
  MeanEstimate estimate() const { return {mean_, n_ > 1 ? variance() / double(n_) : 0, n_}; }

 private:
  int64_t n_ = 0;
  double mean_ = 0, m2_ = 0;
};

MeanEstimate estimate_mean(std::span<const double> values);

/// Welch's test of whether means are equal whose values may have different variances.
/// Source: Welch, "The generalization of Student's problem when several different population
/// variances are involved", Biometrika 34, 1947.
struct WelchTest {
  double t = 0;      ///< difference of the means over its standard error
  double error = 0;  ///< that standard error
  double dof = 1;    ///< Welch & Satterthwaite's degrees of freedom
  double p = 1;      ///< probability of a larger |t| if the means are equal
};
/// `margin` is a difference that does not count: it is taken off that of the means. Means without
/// any error are equal (p is 1) or not (p is 0).
WelchTest welch_test(const MeanEstimate& a, const MeanEstimate& b, double margin = 0);

}  // namespace duet
