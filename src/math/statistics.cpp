#include "math/statistics.h"

#include <limits>

namespace duet {

double normal_p_value(double z) {
  return std::erfc(std::abs(z) / std::sqrt(2.0));
}

double normal_quantile(double p) {
  double low = 0, high = 40;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (normal_p_value(middle) > p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double sidak(double alpha, int n) {
  return -std::expm1(std::log1p(-alpha) / n);
}

double normal_of_student(double t, double dof) {
  return (8 * dof + 1) / (8 * dof + 3) * std::sqrt(dof * std::log1p(t * t / dof));
}

double student_of_normal(double z, double dof) {
  const double s = z * (8 * dof + 3) / (8 * dof + 1);
  return std::sqrt(dof * std::expm1(s * s / dof));
}

WelchTest welch_test(const Moments& a, const Moments& b) {
  WelchTest w;
  const double va = a.error() * a.error(), vb = b.error() * b.error();
  const double difference = a.mean() - b.mean();
  w.error = std::sqrt(va + vb);
  if (!(va + vb > 0)) {
    w.p = difference == 0 ? 1 : 0;
    w.t = difference == 0 ? 0 : std::copysign(std::numeric_limits<double>::infinity(), difference);
    return w;
  }
  w.t = difference / w.error;
  w.dof =
      (va + vb) * (va + vb) / (va * va / double(a.count() - 1) + vb * vb / double(b.count() - 1));
  w.p = normal_p_value(normal_of_student(w.t, w.dof));
  return w;
}

}  // namespace duet
