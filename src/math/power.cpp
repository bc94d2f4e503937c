#include "math/power.h"

#include <cmath>

#include "math/statistics.h"

namespace duet {

namespace {

/// The normal quantile of kPowerShare; normal_quantile() counts both tails.
double power_quantile() {
  static const double q = normal_quantile(2 * (1 - kPowerShare));
  return q;
}

}  // namespace

double noticed_difference(double error, double dof, double level) {
  if (!(error > 0)) return 0;
  const double critical = student_of_normal(normal_quantile(level), dof);
  return error * (critical + power_quantile() * std::sqrt(1 + critical * critical / (2 * dof)));
}

double noticed_excess(double error, double dof) {
  return error > 0 ? error * student_of_normal(power_quantile(), dof) : 0;
}

double jackknife_error(int groups, const std::function<double(int)>& value) {
  Moments m;
  for (int g = 0; g < groups; ++g) m.add(value(g));
  const double n = groups;
  return std::sqrt(m.variance() / n) * (n - 1);
}

}  // namespace duet
