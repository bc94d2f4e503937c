// A point where a walk has come to, with all that joins need to know about it.
#pragma once

#include "scene/scene.h"
#include "transport/mis.h"

namespace duet {

struct PathVertex {
  Surface surface;
  Vector3f wo;  ///< unit, towards the previous vertex
  Bsdf bsdf;    ///< bound to wo
  /// Light walk: flux on arrival. Eye walk: what radiance towards wo counts for the pixel.
  Spectrum throughput;
  Partials partials;
  int depth;  ///< segments from the light or the lens to here

  PathVertex(const Scene& scene, const Surface& s, const Vector3f& towards_previous,
             const Spectrum& carried, const Partials& p, int segments)
      : surface(s),
        wo(towards_previous),
        bsdf(scene.materials[s.shape->material]->bind(surface, wo)),
        throughput(carried),
        partials(p),
        depth(segments) {}

  const Point3f& position() const { return surface.position; }
  /// |cos| between a unit direction and the geometric normal: what densities per area go by.
  float cosine(const Vector3f& w) const { return std::abs(dot(surface.ng, w)); }
};

/// By how much scattering of particles from direction `l` into direction `v` differs from the BSDF
/// times the cosine between v and the shading normal, where shading normals are not geometric ones.
/// Unbounded at grazing angles. Source: Veach 1997, equation 5.19.
inline float adjoint_factor(const Surface& s, const Vector3f& l, const Vector3f& v) {
  const float shading = dot(s.shading.n, v) * dot(s.ng, l);
  const float geometric = dot(s.shading.n, l) * dot(s.ng, v);
  if (shading == geometric) return 1;
  return shading != 0 ? std::abs(geometric / shading) : 0.0f;
}

}  // namespace duet
