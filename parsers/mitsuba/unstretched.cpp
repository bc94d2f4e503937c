#include "mitsuba/unstretched.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace duet {

namespace {

using Axis = std::array<double, 3>;

double dot(const Axis& a, const Axis& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace

std::optional<Matrix4> unstretched(const Matrix4& to_world) {
  std::array<Axis, 3> axes{to_world.turned({1, 0, 0}), to_world.turned({0, 1, 0}),
                           to_world.turned({0, 0, 1})};
  const double square = dot(axes[0], axes[0]);
  double difference = 0;
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = i; j < 3; ++j)
      difference = std::max(difference, std::abs(dot(axes[i], axes[j]) - (i == j ? square : 0)));
  constexpr double kFewDigits = 1e-3;
  if (difference <= kFewDigits * square) return std::nullopt;
  Matrix4 round = to_world;
  for (size_t i = 1; i < 3; ++i) {
    for (size_t j = 0; j < i; ++j) {
      const double along = dot(axes[i], axes[j]) / square;
      for (size_t k = 0; k < 3; ++k) axes[i][k] -= along * axes[j][k];
    }
    const double stretch = std::sqrt(square / dot(axes[i], axes[i]));
    for (size_t k = 0; k < 3; ++k) round[int(k)][i] = axes[i][k] *= stretch;
  }
  return round;
}

}  // namespace duet
