#include "math/orthogonal.h"

#include <cmath>

namespace duet {

std::array<double, 3> duff_orthogonal(const std::array<double, 3>& d) {
  const auto [x, y, z] = d;
  const double sign = std::copysign(1.0, z), a = -1 / (sign + z);
  return {sign * x * x * a + 1, sign * x * y * a, -sign * x};
}

std::array<double, 3> axis_orthogonal(const std::array<double, 3>& d) {
  const auto [x, y, z] = d;
  const bool flat = std::abs(x) > std::abs(y);
  const double length = flat ? std::hypot(x, z) : std::hypot(y, z);
  const std::array<double, 3> t =
      flat ? std::array{z / length, 0.0, -x / length} : std::array{0.0, z / length, -y / length};
  return {t[1] * z - t[2] * y, t[2] * x - t[0] * z, t[0] * y - t[1] * x};
}

}  // namespace duet
