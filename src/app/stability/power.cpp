#include "app/stability/power.h"

#include <algorithm>
#include <cmath>

namespace duet::stability {

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

Power limit_power(double limit, double slack, double error, double dof) {
  const double noise = error > 0 ? error * student_of_normal(power_quantile(), dof) : 0;
  Power p;
  p.noticed = limit + std::copysign(noise, slack);
  p.required = limit + slack;
  p.noise = noise / std::abs(slack);
  return p;
}

double jackknife_error(int groups, const std::function<double(int)>& value) {
  Moments m;
  for (int g = 0; g < groups; ++g) m.add(value(g));
  const double n = groups;
  return std::sqrt(m.variance() * (n - 1) * (n - 1) / n);
}

void grow_images(int first, int most, const std::function<double(int)>& noise) {
  // Few images more tell little more; and what few images say about the noise is not certain.
  constexpr double kLeast = 1.25, kMost = 4, kReserve = 1.1;
  for (int images = std::min(first, most);;) {
    const double now = noise(images);
    if (now <= 1 || images >= most) return;
    const double factor = std::clamp(kReserve * now * now, kLeast, kMost);
    images = int(std::min(double(most), std::ceil(images * factor)));
  }
}

}  // namespace duet::stability
