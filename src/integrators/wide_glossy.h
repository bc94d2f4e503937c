// What batches of paths do at points of glossy and of specular materials has in common.
#pragma once

#include "base/instruction_sets.h"
#include "integrators/wide_state.h"
#include "materials/microfacet.h"
#include "materials/model.h"

namespace duet {

/// What the points of a batch have: see WideTracer.
struct WideVertices {
  const WidePaths& paths;
  const WidePoints& points;  ///< the reflectance is what the material takes from textures
  const WideNumbers& numbers;
  Transport transport = Transport::radiance;  ///< what the paths carry
};

/// Some of the points, and what is made of them, without gaps.
struct WideGlossy {
  BatchArray<int32_t> at;  ///< numbers of the points
  BatchTriples towards;    ///< unit directions that the material is asked about
  BatchTriples value;      ///< of the BSDF
  BatchArray<float> value_pdf;
  BatchArray<float> reverse;  ///< density of going back from the direction, in the other transport
  BatchTriples wi, weight;    ///< see WideScattering
  BatchArray<float> pdf, roulette;
  BatchArray<int32_t> alive;
  BatchArray<float> eta;     ///< of rough dielectrics and specular materials alone
  BatchArray<int32_t> null;  ///< of specular materials alone
};

/// Facets of one kind, so that loops need not ask for it: GGX, all visible and without correlation.
struct WideGgx {
  Microfacet facets;

  [[gnu::always_inline]] explicit WideGgx(const Microfacet& m) : facets(m) {}
  [[gnu::always_inline]] Microfacet::Reflection reflection(const Vector3f& o,
                                                           const Vector3f& i) const {
    return facets.visible_ggx_reflection(o, i);
  }
  [[gnu::always_inline]] Microfacet::Core core(const Vector3f& o, const Vector3f& i,
                                               const Vector3f& h) const {
    return facets.visible_ggx_core(o, i, h);
  }
  [[gnu::always_inline]] Vector3f sample(const Vector3f& o, const Point2f& u) const {
    return facets.sample_visible_ggx(o, u);
  }
};

/// The same of Beckmann's.
struct WideBeckmann {
  BeckmannFacets facets;

  [[gnu::always_inline]] explicit WideBeckmann(const Microfacet& m) : facets(m.beckmann()) {}
  [[gnu::always_inline]] Microfacet::Reflection reflection(const Vector3f& o,
                                                           const Vector3f& i) const {
    return Microfacet::reflection_by(
        o, i, [&](const Vector3f& h) __attribute__((always_inline)) { return core(o, i, h); });
  }
  [[gnu::always_inline]] Microfacet::Core core(const Vector3f& o, const Vector3f& i,
                                               const Vector3f& h) const {
    return facets.core(o, i, h);
  }
  [[gnu::always_inline]] Vector3f sample(const Vector3f& o, const Point2f& u) const {
    return facets.sample(o, u);
  }
};

/// Calls `f` with the type of the facets.
template <class F>
[[gnu::always_inline]] inline void with_facets(const Microfacet& facets, const F& f) {
  if (facets.is_visible_beckmann())
    f.template operator()<WideBeckmann>();
  else
    f.template operator()<WideGgx>();
}

/// A point in its shading frame, mirrored if it is seen from its back.
struct LocalPoint {
  Frame frame;
  float side;
  Vector3f wo;

  [[gnu::always_inline]] LocalPoint(const Normal3f& n, const Vector3f& wo_world, bool two_sided)
      : frame(n), wo(frame.to_local(wo_world)) {
    const float back = two_sided ? -1.0f : 1.0f;
    side = wo.z < 0 ? back : 1.0f;
    wo.z *= side;
  }
  [[gnu::always_inline]] Vector3f to_local(const Vector3f& w) const {
    const Vector3f local = frame.to_local(w);
    return {local.x, local.y, local.z * side};
  }
  [[gnu::always_inline]] Vector3f to_world(const Vector3f& w) const {
    return frame.to_world({w.x, w.y, w.z * side});
  }
};

[[gnu::always_inline]] inline LocalPoint local_point(const WideVertices& vertices, int i,
                                                     bool two_sided) {
  return {vertices.points.ns.normal(i), -vertices.paths.ray.direction.vector(i), two_sided};
}

[[gnu::always_inline]] inline Spectrum reflectance_at(const WidePoints& points, int i) {
  return color_at(points.reflectance, i);
}

/// What `eval(point, wo, wi)` gives for the directions `out.towards`, of n points: a ModelEval for
/// directions in the shading frame.
template <class Eval>
[[gnu::always_inline]] inline void evaluate_points(int n, bool two_sided,
                                                   const WideVertices& vertices, WideGlossy& out,
                                                   const Eval& eval) {
  const WideVertices v = vertices;
  DUET_LANES
  for (int k = 0; k < n; ++k) {
    const int i = out.at[k];
    const LocalPoint at = local_point(v, i, two_sided);
    const ModelEval e = eval(i, at.wo, at.to_local(out.towards.vector(k)));
    out.value.set(k, e.value.r, e.value.g, e.value.b);
    out.value_pdf[k] = e.pdf;
  }
}

/// The reverse densities by the same function.
template <class Eval>
[[gnu::always_inline]] inline void reverse_points(int n, bool two_sided,
                                                  const WideVertices& vertices, WideGlossy& out,
                                                  const Eval& eval) {
  const WideVertices v = vertices;
  DUET_LANES
  for (int k = 0; k < n; ++k) {
    const int i = out.at[k];
    const LocalPoint at = local_point(v, i, two_sided);
    out.reverse[k] = eval(i, at.to_local(out.towards.vector(k)), at.wo).pdf;
  }
}

/// `w`, or its mirror image if it is below the horizon, where formulas may divide by zero.
[[gnu::always_inline]] inline Vector3f above_horizon(const Vector3f& w) {
  return {w.x, w.y, std::abs(w.z)};
}

/// Of directions below the horizon nothing.
[[gnu::always_inline]] inline ModelEval if_above(const Vector3f& wo, const Vector3f& wi,
                                                 const ModelEval& e) {
  const bool above = std::min(wo.z, wi.z) > kMinCosine;
  return {{above ? e.value.r : 0, above ? e.value.g : 0, above ? e.value.b : 0}, above ? e.pdf : 0};
}

}  // namespace duet
