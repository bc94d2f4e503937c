#include "math/significance.h"

#include <cmath>

namespace duet {

namespace {

/// Regularised incomplete beta function I_x(a, b) by its continued fraction (Abramowitz & Stegun,
/// 26.5.8).
double incomplete_beta(double x, double a, double b) {
  if (!(x > 0)) return 0;
  if (!(x < 1)) return 1;
  // The fraction converges fast on this side of the mean.
  if (x > (a + 1) / (a + b + 2)) return 1 - incomplete_beta(1 - x, b, a);
  const double front = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) +
                                a * std::log(x) + b * std::log1p(-x)) /
                       a;
  // Backwards, so that nothing can vanish in a denominator; a hundred pairs are more than it takes.
  double fraction = 1;
  for (int m = 100; m >= 0; --m) {
    fraction = 1 - (a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1) * fraction);
    if (m > 0) fraction = 1 + m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m) * fraction);
  }
  return front / fraction;
}

}  // namespace

MeanEstimate estimate_mean(std::span<const double> values) {
  MeanEstimate e;
  e.count = int(values.size());
  if (e.count == 0) return e;
  for (const double v : values) e.mean += v;
  e.mean /= e.count;
  double squares = 0;
  for (const double v : values) squares += (v - e.mean) * (v - e.mean);
  if (e.count > 1) e.error2 = squares / (double(e.count - 1) * e.count);
  return e;
}

double student_p_value(double t, double degrees_of_freedom) {
  const double n = degrees_of_freedom;
  return incomplete_beta(n / (n + t * t), 0.5 * n, 0.5);
}

double welch_p_value(const MeanEstimate& a, const MeanEstimate& b, double margin) {
  const double excess = std::abs(a.mean - b.mean) - margin, error2 = a.error2 + b.error2;
  if (!(excess > 0)) return excess <= 0 ? 1 : 0;  // what is not a number differs
  if (!(error2 > 0)) return 0;
  const auto share = [](const MeanEstimate& e) {
    return e.count > 1 ? e.error2 * e.error2 / (e.count - 1) : 0;
  };
  return student_p_value(excess / std::sqrt(error2), error2 * error2 / (share(a) + share(b)));
}

double sidak_level(double alpha, double tests) {
  return -std::expm1(std::log1p(-alpha) / tests);
}

}  // namespace duet
