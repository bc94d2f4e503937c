#include "math/statistics.h"

#include <algorithm>
#include <limits>

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

/// The argument at which a decreasing function falls to `value`, between 0 and `high`.
template <class F>
double argument_of(const F& f, double value, double high) {
  double low = 0;
  for (int i = 0; i < 100 && high - low > 1e-14 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (f(middle) > value ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

double normal_p_value(double z) {
  return std::erfc(std::abs(z) / std::sqrt(2.0));
}

double normal_quantile(double p) {
  return argument_of(normal_p_value, p, 40);
}

double student_p_value(double t, double dof) {
  // The two differ by a share of t^4 / (4 dof) of the probability; where the variance is known
  // exactly, dof is infinite.
  if (dof > 1e8) return normal_p_value(t);
  return incomplete_beta(dof / (dof + t * t), 0.5 * dof, 0.5);
}

double normal_of_student(double t, double dof) {
  return normal_quantile(student_p_value(t, dof));
}

double student_of_normal(double z, double dof) {
  const double p = normal_p_value(z);
  double high = 1 + std::abs(z);
  while (student_p_value(high, dof) > p && high < 1e100) high *= 2;
  return argument_of([&](double t) { return student_p_value(t, dof); }, p, high);
}

double chi_square_p_value(double x, double dof) {
  if (!(x > 0)) return 1;
  const double a = 0.5 * dof, h = 0.5 * x;
  const double front = std::exp(a * std::log(h) - h - std::lgamma(a));
  constexpr int kMany = 10000;
  if (h < a + 1) {  // one minus the series of the lower part
    double term = 1 / a, sum = term;
    for (int n = 1; n < kMany && term > 1e-17 * sum; ++n) sum += term *= h / (a + n);
    return std::max(0.0, 1 - front * sum);
  }
  // The continued fraction of the upper part, backwards; far from its start it converges fast.
  double fraction = 0;
  for (int n = 200; n >= 1; --n) fraction = n * (n - a) / (h + 2 * n + 1 - a - fraction);
  return front / (h + 1 - a - fraction);
}

double sidak(double alpha, double tests) {
  return -std::expm1(std::log1p(-alpha) / tests);
}

double sidak_p_value(double p, double tests) {
  return p < 1 ? -std::expm1(tests * std::log1p(-p)) : 1;
}

MeanEstimate estimate_mean(std::span<const double> values) {
  Moments m;
  for (const double v : values) m.add(v);
  return m.estimate();
}

WelchTest welch_test(const MeanEstimate& a, const MeanEstimate& b, double margin) {
  WelchTest w;
  const double excess = std::abs(a.mean - b.mean) - margin, error2 = a.error2 + b.error2;
  w.error = std::sqrt(error2);
  const auto share = [](const MeanEstimate& e) {
    return e.count > 1 ? e.error2 * e.error2 / double(e.count - 1) : 0;
  };
  if (error2 > 0) w.dof = error2 * error2 / (share(a) + share(b));
  if (excess <= 0) return w;
  const double sign = a.mean < b.mean ? -1.0 : 1.0;
  if (!(excess > 0 && error2 > 0)) {  // what is not a number differs, too
    w.t = sign * std::numeric_limits<double>::infinity();
    w.p = 0;
    return w;
  }
  w.t = sign * excess / w.error;
  w.p = student_p_value(w.t, w.dof);
  return w;
}

}  // namespace duet
