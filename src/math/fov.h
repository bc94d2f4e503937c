// Fields of view measured along different axes of an image.
#pragma once

#include <cmath>

#include "math/angles.h"

namespace duet {

/// The axis of the image along which a field of view is given.
enum class FovAxis { x, y, diagonal, smaller, larger };

/// The horizontal field of view in degrees of an image `aspect` times as wide as high.
inline double horizontal_fov(double fov, FovAxis axis, double aspect) {
  const double t = std::tan(0.5 * fov * kRadians);
  if (axis == FovAxis::smaller) axis = aspect > 1 ? FovAxis::y : FovAxis::x;
  if (axis == FovAxis::larger) axis = aspect > 1 ? FovAxis::x : FovAxis::y;
  double half_width = t;
  if (axis == FovAxis::y) half_width = t * aspect;
  if (axis == FovAxis::diagonal) half_width = t / std::sqrt(1 + 1 / (aspect * aspect));
  return 2 * std::atan(half_width) / kRadians;
}

/// The diagonal field of view in degrees of a lens of that many millimetres before 36 mm × 24 mm
/// film.
inline double diagonal_fov(double focal_length) {
  const double diagonal = std::sqrt(36.0 * 36 + 24 * 24);
  return 2 * std::atan(diagonal / (2 * focal_length)) * kDegrees;
}

}  // namespace duet
