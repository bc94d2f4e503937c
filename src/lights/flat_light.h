// A flat light, whose samples have a closed form.
#pragma once

#include "math/spectrum.h"
#include "math/warp.h"

namespace duet {

/// A light that is a parallelogram or an ellipse and shines on one side, the same everywhere. Its
/// light samples have a closed form without branches, which is also that of many points at once.
struct FlatLight {
  Point3f origin;           ///< a corner, or the centre of the ellipse; just off its surface
  Vector3f edge_u, edge_v;  ///< from the corner; from the centre to the rim
  Normal3f normal;
  Spectrum radiance;
  float area = 0;
  float round = 0;  ///< 1 for an ellipse, else 0

  /// A light sample without the radiance.
  struct Sample {
    Point3f target;
    Vector3f wi;
    float facing;  ///< positive if the light is seen from its side; the rest is valid only then
    float solid_angle;  ///< area · cos θ / d²
    float pdf;          ///< per solid angle
  };
  /// `p` is the point in units of the edges: uniform on the unit square, or on the unit disk.
  [[gnu::always_inline]] Sample sample_at(const Point3f& from, const Point2f& p) const {
    Sample s;
    s.target = origin + (edge_u * p.x + edge_v * p.y);
    const Vector3f d = s.target - from;
    s.facing = -dot(normal, d);
    const float d2 = length_squared(d), distance = std::sqrt(d2), inv_distance = 1 / distance;
    // what a density per area becomes per solid angle
    const float projected = s.facing * area;
    s.solid_angle = projected * inv_distance * inv_distance * inv_distance;
    s.wi = d * inv_distance;
    s.pdf = d2 * distance / projected;
    return s;
  }
  [[gnu::always_inline]] Sample sample(const Point3f& from, const Point2f& u) const {
    return sample_at(from, round != 0 ? square_to_disk(u) : u);
  }
};

}  // namespace duet
