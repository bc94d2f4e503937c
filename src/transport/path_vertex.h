// A point where a sub-path has come to, with all that connections need to know about it.
#pragma once

#include "scene/scene.h"
#include "transport/mis.h"

namespace duet {

/// A vertex on a surface, the only kind where there are no media. What sub-paths and connections
/// ask of vertices has one name for all kinds.
struct PathVertex {
  /// Whether there are vertices elsewhere.
  static constexpr bool kMedia = false;

  Surface surface;
  Vector3f wo;  ///< unit, towards the previous vertex
  Bsdf bsdf;    ///< bound to wo
  /// Light sub-path: flux on arrival. Eye sub-path: what radiance towards wo counts for the pixel.
  Spectrum throughput;
  Partials partials;
  int depth;  ///< segments from the light or the lens to here
  /// Of the first vertex of a light sub-path: of direct light here that an eye sub-path would find.
  LightSampleVariance light_sample{};

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
  /// Whether the vertex can be connected with others.
  bool is_smooth() const { return bsdf.has_smooth(); }
  /// Whether photons can be merged with it.
  bool merges() const { return bsdf.merges(); }
  /// The same for light that is scattered with these densities; see Bsdf::merges().
  bool merges(float pdf, float reverse) const { return bsdf.merges(pdf, reverse); }
  BsdfEval eval(const Vector3f& w, Transport transport) const { return bsdf.eval(w, transport); }
  BsdfPair eval_both_ways(const Vector3f& w, Transport transport) const {
    return bsdf.eval_both_ways(w, transport);
  }
  /// As Bsdf::reverse_pdf().
  float reverse_pdf(const Vector3f& w, Transport transport) const {
    return bsdf.reverse_pdf(w, transport).value;
  }
  /// Of particles that are scattered towards `w`.
  float adjoint(const Vector3f& w) const;
  /// Whether a direction lies on different sides of the shading and the geometric normal.
  bool has_two_sides(const Vector3f& w) const { return sides_differ(surface, w); }
  /// Where a ray towards `w` starts, and where one from there ends.
  Point3f outside(const Vector3f& w) const { return offset_position(surface, w); }

 protected:
  /// For a point that is on no surface.
  PathVertex(const Point3f& p, const Vector3f& towards_previous, const Spectrum& carried,
             const Partials& sums, int segments)
      : wo(towards_previous), throughput(carried), partials(sums), depth(segments) {
    surface.position = p;
    surface.shape = nullptr;
  }
};

/// By how much scattering of particles from direction `l` into direction `v` differs from the BSDF
/// times the cosine between v and the shading normal, where shading normals are not geometric ones.
/// Unbounded at grazing angles. Source: Veach 1997, equation 5.19.
/// `ns` and `ng` are the normals.
[[gnu::always_inline]] inline float adjoint_factor(const Normal3f& ns, const Normal3f& ng,
                                                   const Vector3f& l, const Vector3f& v) {
  const float shading = dot(ns, v) * dot(ng, l);
  const float geometric = dot(ns, l) * dot(ng, v);
  const float ratio = std::abs(geometric / shading), bounded = shading != 0 ? ratio : 0.0f;
  return shading == geometric ? 1.0f : bounded;
}
inline float adjoint_factor(const Surface& s, const Vector3f& l, const Vector3f& v) {
  return adjoint_factor(s.shading.n, s.ng, l, v);
}

inline float PathVertex::adjoint(const Vector3f& w) const {
  return adjoint_factor(surface, wo, w);
}

}  // namespace duet
