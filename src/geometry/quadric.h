// Where rays meet the unit sphere, the unit cylinder and the unit disk.
#pragma once

#include <algorithm>
#include <cmath>

#include "geometry/shape.h"

namespace duet {

/// A point or a direction in the space of a shape.
struct LocalVector {
  double x, y, z;
};

/// The point (w = 1) or the direction (w = 0) of world space.
inline LocalVector to_local(const Matrix4& m, double x, double y, double z, double w) {
  return {m[0][0] * x + m[0][1] * y + m[0][2] * z + m[0][3] * w,
          m[1][0] * x + m[1][1] * y + m[1][2] * z + m[1][3] * w,
          m[2][0] * x + m[2][1] * y + m[2][2] * z + m[2][3] * w};
}

inline LocalVector to_local(const Matrix4& m, const Point3f& p) {
  return to_local(m, double(p.x), double(p.y), double(p.z), 1);
}
inline LocalVector to_local(const Matrix4& m, const Vector3f& v) {
  return to_local(m, double(v.x), double(v.y), double(v.z), 0);
}

/// The distance of the nearest intersection in (tnear, tfar), in units of the direction's length,
/// or INFINITY. Without branches, so that loops over rays can be vectorised: what does not exist is
/// not a number, and compares as false. The discriminant is formed from the point of closest
/// approach, which keeps its digits for far origins. Source: Haines et al., "Precision Improvements
/// for Ray/Sphere Intersection", Ray Tracing Gems, 2019.
template <ShapeKind kind>
inline double quadric_distance(const LocalVector& o, const LocalVector& d, double tnear,
                               double tfar) {
  const auto within = [&](double t) {
    return std::min(t - tnear, tfar - t) > 0 ? t : double(INFINITY);
  };
  if constexpr (kind == ShapeKind::disk) {
    const double t = -o.z / d.z;
    const double x = o.x + t * d.x, y = o.y + t * d.y;
    return x * x + y * y <= 1 ? within(t) : double(INFINITY);
  } else {
    constexpr double z = kind == ShapeKind::sphere ? 1 : 0;
    const double a = d.x * d.x + d.y * d.y + z * d.z * d.z;
    const double b = -(o.x * d.x + o.y * d.y + z * o.z * d.z) / a;
    const double px = o.x + b * d.x, py = o.y + b * d.y, pz = z * (o.z + b * d.z);
    const double h = std::sqrt((1 - (px * px + py * py + pz * pz)) / a);
    const double first = within(b - h), second = within(b + h);
    if constexpr (kind == ShapeKind::sphere) return std::min(first, second);
    const auto on_side = [&](double t) {
      const double height = o.z + t * d.z;
      return std::min(height, 1 - height) >= 0 ? t : double(INFINITY);
    };
    return std::min(on_side(first), on_side(second));
  }
}

/// Rays of a packet, as arrays of the same length.
struct RayLanes {
  const float *origin_x, *origin_y, *origin_z, *tnear;
  const float *direction_x, *direction_y, *direction_z, *tfar;
};

/// quadric_distance() for the first `n` rays, in single precision.
void quadric_distances(const Shape& shape, const RayLanes& rays, unsigned n, float* t);

}  // namespace duet
