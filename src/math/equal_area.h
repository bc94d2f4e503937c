// A map between the sphere of directions and the unit square that keeps areas: an octahedron that
// is folded open. Source: Clarberg, "Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD", 2008.
#pragma once

#include <algorithm>
#include <cmath>

#include "math/vector.h"

namespace duet {

/// The direction of a point of the square, of length one: +z is in its middle, −z in its corners,
/// +x in the middle of the edge x = 1, +y in that of the edge y = 1.
inline Vector3f square_to_sphere_equal_area(const Point2f& p) {
  const float u = 2 * p.x - 1, v = 2 * p.y - 1;
  const float side = 1 - (std::abs(u) + std::abs(v));
  const float r = 1 - std::abs(side);
  const float phi = 0.25f * kPi * (r == 0 ? 1.0f : (std::abs(v) - std::abs(u)) / r + 1);
  const float aside = r * std::sqrt(std::max(2 - r * r, 0.0f));
  return {std::copysign(std::cos(phi) * aside, u), std::copysign(std::sin(phi) * aside, v),
          std::copysign(1 - r * r, side)};
}

/// The point of the square that stands for a direction of length one.
inline Point2f sphere_to_square_equal_area(const Vector3f& d) {
  const float x = std::abs(d.x), y = std::abs(d.y);
  const float r = std::sqrt(std::max(1 - std::abs(d.z), 0.0f));
  const float share = x == 0 && y == 0 ? 0.0f : std::atan2(y, x) * (2 / kPi);
  float v = share * r, u = r - v;
  if (d.z < 0) {
    std::swap(u, v);
    u = 1 - u, v = 1 - v;
  }
  return {0.5f * (std::copysign(u, d.x) + 1), 0.5f * (std::copysign(v, d.y) + 1)};
}

}  // namespace duet
