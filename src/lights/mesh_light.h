// Points of surfaces that emit, seen from elsewhere, and meshes that shine the same everywhere:
// the form of their light samples for many points at once.
#pragma once

#include "lights/emitting_side.h"
#include "math/spectrum.h"

namespace duet {

/// A point of a surface that emits: see ShapePoint.
struct EmittingPoint {
  Point3f position;
  Vector3f ng, ns;
  float offset;
};

/// It as a light sample.
struct SeenPoint {
  Vector3f wi;     ///< towards it
  Point3f target;  ///< just off the surface
  float pdf;       ///< per solid angle; not above zero unless light leaves it that way
};

/// An EmittingSide as numbers.
struct SideFactors {
  float two_sided = 0, by_shading = 0;  ///< 1 or 0

  SideFactors() = default;
  explicit SideFactors(EmittingSide side)
      : two_sided(side == EmittingSide::both ? 1.0f : 0.0f),
        by_shading(side == EmittingSide::shading ? 1.0f : 0.0f) {}

  /// `density` is that of the point per area. Without branches.
  [[gnu::always_inline]] SeenPoint see(const Point3f& from, const EmittingPoint& p,
                                       float density) const {
    const Vector3f d = p.position - from;
    const float d2 = length_squared(d);
    SeenPoint s;
    s.wi = d * (1 / std::sqrt(d2));
    const float facing = -dot(p.ng, s.wi), leaving = -dot(p.ns, s.wi);
    const bool turned = two_sided * facing < 0;
    const float cosine = turned ? -facing : facing;
    const float least = std::min(cosine, by_shading > 0 ? leaving : cosine);
    s.target = p.position + p.ng * (turned ? -p.offset : p.offset);
    s.pdf = least > 0 ? density * d2 / cosine : 0.0f;
    return s;
  }
};

struct MeshLight {
  Spectrum radiance;
  /// The density of a light sample's point per area; 0 if that depends on the triangle.
  float even = 0;
  float emission = 0;  ///< LightSample::emission
  SideFactors sides;
};

}  // namespace duet
