#include "evaluate/stability/power.h"

#include <algorithm>
#include <cmath>

namespace duet::stability {

Power limit_power(double limit, double slack, double error, double dof) {
  const double noise = noticed_excess(error, dof);
  return {limit + std::copysign(noise, slack), limit + slack, noise / std::abs(slack)};
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
