// Maps from the unit square to other domains, each with its density beside it.
#pragma once

#include "math/trig.h"

namespace duet {

/// The largest number below 1: what is left of a random number after a choice stays in [0, 1).
constexpr float kBelowOne = 0x1.fffffep-1f;

/// Uniform on the unit disk; keeps neighbouring points together.
/// Source: Shirley & Chiu, "A Low Distortion Map Between Disk and Square", 1997.
[[gnu::always_inline]] inline Point2f square_to_disk(const Point2f& u) {
  const float a = 2 * u.x - 1, b = 2 * u.y - 1;
  // Which coordinate is larger cannot be predicted: choose without a branch.
  const float steep = float(std::abs(a) < std::abs(b));
  const float r = a + steep * (b - a), other = b + steep * (a - b);
  float sine, cosine;
  // The summand matters only in the centre, where both are zero.
  small_sincos((kPi / 4) * other / (r + std::copysign(1e-30f, r)), sine, cosine);
  return {r * (cosine + steep * (sine - cosine)), r * (sine + steep * (cosine - sine))};
}

/// The point of the square that square_to_disk() takes to a point of the disk.
inline Point2f disk_to_square(const Point2f& d) {
  const float r = std::sqrt(d.x * d.x + d.y * d.y);
  if (r == 0) return {0.5f, 0.5f};
  const bool steep = std::abs(d.x) < std::abs(d.y);
  const float along = std::copysign(r, steep ? d.y : d.x);
  const float across = along * (4 / kPi) * std::atan(steep ? d.x / d.y : d.y / d.x);
  return {0.5f * ((steep ? across : along) + 1), 0.5f * ((steep ? along : across) + 1)};
}

/// Density cos θ / π per solid angle on the upper hemisphere.
[[gnu::always_inline]] inline Vector3f square_to_cosine_hemisphere(const Point2f& u) {
  const Point2f d = square_to_disk(u);
  return {d.x, d.y, safe_sqrt(1 - d.x * d.x - d.y * d.y)};
}

/// The angle of (x, y) from the x axis, in turns: in [0, 1).
inline float turns(float x, float y) {
  const float t = atan2_turns(y, x);
  return std::min(t < 0 ? t + 1 : t, kBelowOne);
}

/// Density 1 / 4π on the unit sphere.
inline Vector3f square_to_sphere(const Point2f& u) {
  const float z = 1 - 2 * u.y, r = safe_sqrt(1 - z * z);
  float sine, cosine;
  sincos_turns(u.x, sine, cosine);
  return {r * cosine, r * sine, z};
}

/// The point of the square that square_to_sphere() takes to a unit direction.
inline Point2f sphere_to_square(const Vector3f& d) {
  return {turns(d.x, d.y), std::clamp(0.5f * (1 - d.z), 0.0f, kBelowOne)};
}

/// Uniform in the cone around +z whose half angle has 1 − cosine = `one_minus_cos`
/// (given so, because cos θ of a narrow cone loses all its digits).
inline Vector3f square_to_cone(const Point2f& u, float one_minus_cos) {
  const float h = u.x * one_minus_cos;  // 1 − cos θ
  const float sin_theta = safe_sqrt(h * (2 - h));
  float sine, cosine;
  sincos_turns(u.y, sine, cosine);
  return {sin_theta * cosine, sin_theta * sine, 1 - h};
}

/// The point of the square that square_to_cone() takes to a unit direction, or one at the edge if
/// the direction is outside of the cone.
inline Point2f cone_to_square(const Vector3f& d, float one_minus_cos) {
  const float sin2 = d.x * d.x + d.y * d.y;
  const float h = d.z > 0 ? sin2 / (1 + d.z) : 1 - d.z;
  return {std::min(h / one_minus_cos, kBelowOne), turns(d.x, d.y)};
}

/// Barycentric coordinates (b1, b2), uniform on a triangle.
inline Point2f square_to_triangle(const Point2f& u) {
  const float t = safe_sqrt(1 - u.x);
  return {1 - t, t * u.y};
}

}  // namespace duet
