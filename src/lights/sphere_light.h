// A sphere that shines outwards, whose samples have a closed form.
#pragma once

#include "math/frame.h"
#include "math/spectrum.h"
#include "math/warp.h"

namespace duet {

/// A spherical light, seen from outside. Light samples choose a direction uniformly in the cone
/// that it fills; without branches, which is also the form for many points at once.
struct SphereLight {
  Point3f center{0};
  float radius = 0;
  Spectrum radiance;   ///< if it is the same everywhere
  float offset = 0;    ///< by which rays towards it keep off its surface
  float emission = 0;  ///< LightSample::emission

  /// A light sample without the radiance.
  struct Sample {
    Vector3f wi;
    Normal3f normal;  ///< of the sphere at the point, of unit length
    float pdf;        ///< per solid angle; 0 from within, where the rest is not valid

    Point3f target(const SphereLight& l) const {
      return (l.center + Vector3f(normal) * l.radius) + Vector3f(normal) * l.offset;
    }
  };

  [[gnu::always_inline]] Sample sample(const Point3f& from, const Point2f& u) const {
    const Vector3f axis = center - from;
    const float d2 = length_squared(axis), r2 = radius * radius;
    const float d = std::sqrt(d2);
    const float span = one_minus_cosine(r2 / d2);
    const Vector3f local = square_to_cone(u, span);
    Sample s;
    s.wi = Frame(Normal3f(axis / d)).to_world(local);
    // The nearer intersection, from the triangle of the centre, `from` and the point.
    const float sin2 = local.x * local.x + local.y * local.y;
    const float t = d * local.z - safe_sqrt(r2 - d2 * sin2);
    const Vector3f out = (from + s.wi * t) - center;
    s.normal = Normal3f(out * (1 / std::sqrt(length_squared(out))));
    s.pdf = pdf(d2, r2, span);
    return s;
  }

  /// The density of every direction that sample() makes.
  float pdf(const Point3f& from) const {
    const float d2 = length_squared(center - from), r2 = radius * radius;
    return pdf(d2, r2, one_minus_cosine(r2 / d2));
  }

 private:
  /// 1 − cos of the half angle under which a sphere appears, from the squared sine.
  [[gnu::always_inline]] static float one_minus_cosine(float sin2) {
    const float narrow = sin2 * (0.5f + 0.125f * sin2), wide = 1 - safe_sqrt(1 - sin2);
    return sin2 < 1e-3f ? narrow : wide;
  }
  [[gnu::always_inline]] static float pdf(float d2, float r2, float span) {
    const float density = 1 / (2 * kPi * span);
    return d2 > r2 ? density : 0.0f;
  }
};

}  // namespace duet
