// Whether means of independent values differ by more than chance explains.
#pragma once

#include <span>

namespace duet {

/// The mean of independent values and the square of its standard error; a value that is known
/// exactly has an error of zero.
struct MeanEstimate {
  double mean = 0, error2 = 0;
  int count = 0;
};
MeanEstimate estimate_mean(std::span<const double> values);

/// Probability that a variate of Student's distribution is further from zero than |t|.
/// Source: Abramowitz & Stegun, 26.7.1, by the incomplete beta function.
double student_p_value(double t, double degrees_of_freedom);

/// Probability that means differ by as much as a and b do if the true difference is `margin`. 1 if
/// they differ by less, 0 if they differ by more and neither has an error.
/// Source: Welch, "The generalization of Student's problem when several different population
/// variances are involved", Biometrika 34, 1947.
double welch_p_value(const MeanEstimate& a, const MeanEstimate& b, double margin = 0);

/// The level of each of `tests` independent tests so that all of them together have level `alpha`.
/// Source: Sidak, "Rectangular confidence regions …", JASA 62, 1967.
double sidak_level(double alpha, double tests);

}  // namespace duet
