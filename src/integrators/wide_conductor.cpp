#include "integrators/wide_conductor.h"

#include "base/instruction_sets.h"

namespace duet {

namespace {

/// The conductor at a point: as its index is the same everywhere, only the reflectance differs.
[[gnu::always_inline]] inline RoughConductorModel model_at(RoughConductorModel conductor,
                                                           const WidePoints& points, int i) {
  conductor.specular_reflectance = reflectance_at(points, i);
  return conductor;
}

/// See RoughConductorModel::eval().
template <class Facets>
[[gnu::always_inline]] inline void evaluate_all(int n, const RoughConductorSurface& surface,
                                                const WideVertices& vertices, WideGlossy& out) {
  const RoughConductorModel conductor = surface.conductor;
  const Facets facets(conductor.microfacet);
  const bool two_sided = surface.two_sided;
  const WideVertices v = vertices;
  DUET_LANES
  for (int k = 0; k < n; ++k) {
    const int i = out.at[k];
    const LocalPoint at = local_point(v, i, two_sided);
    const Vector3f wi = at.to_local(out.towards.vector(k));
    const Microfacet::Reflection r = facets.reflection(above_horizon(at.wo), above_horizon(wi));
    const Spectrum reflected = model_at(conductor, v.points, i).by_index(r.cosine) * r.value;
    const ModelEval e = if_above(at.wo, wi, {reflected, r.density});
    out.value.set(k, e.value.r, e.value.g, e.value.b);
    out.value_pdf[k] = e.pdf;
  }
}

/// See RoughConductorModel::sample().
template <class Facets>
[[gnu::always_inline]] inline void sample_all(int n, const RoughConductorSurface& surface,
                                              const WideVertices& vertices, WideGlossy& out) {
  const RoughConductorModel conductor = surface.conductor;
  const Facets facets(conductor.microfacet);
  const bool two_sided = surface.two_sided;
  const WideVertices v = vertices;
  DUET_LANES
  for (int k = 0; k < n; ++k) {
    const int i = out.at[k];
    const LocalPoint at = local_point(v, i, two_sided);
    const Vector3f o = above_horizon(at.wo);
    const Vector3f m = facets.sample(o, {v.numbers.x[i], v.numbers.y[i]});
    const float cosine = dot(o, m);
    const Vector3f wi = reflect(o, m);
    const Microfacet::Core core = facets.core(o, above_horizon(wi), m);
    const Spectrum weight =
        model_at(conductor, v.points, i).by_index(cosine) * (core.value / core.density);
    out.wi.set(k, at.to_world(wi));
    out.weight.set(k, weight.r, weight.g, weight.b);
    out.pdf[k] = 0.25f * core.density;
    out.roulette[k] = v.numbers.first[i];
    const int32_t facing = cosine > 0 ? (core.density > 0 ? 1 : 0) : 0;
    out.alive[k] = std::min(at.wo.z, wi.z) > kMinCosine ? facing : 0;
  }
}

template <class Facets>
[[gnu::always_inline]] inline void reverse_all(int n, const RoughConductorSurface& surface,
                                               const WideVertices& vertices, WideGlossy& out) {
  const Facets facets(surface.conductor.microfacet);
  const bool two_sided = surface.two_sided;
  const WideVertices v = vertices;
  DUET_LANES
  for (int k = 0; k < n; ++k) {
    const LocalPoint at = local_point(v, out.at[k], two_sided);
    const Vector3f wi = at.to_local(out.towards.vector(k));
    const Microfacet::Reflection r = facets.reflection(above_horizon(wi), above_horizon(at.wo));
    out.reverse[k] = if_above(wi, at.wo, {Spectrum(0), r.density}).pdf;
  }
}

}  // namespace

DUET_WIDEST void evaluate_glossy(int n, const RoughConductorSurface& surface,
                                 const WideVertices& vertices, WideGlossy& out) {
  with_facets(
      surface.conductor.microfacet, [&]<class Facets>() __attribute__((always_inline)) {
        evaluate_all<Facets>(n, surface, vertices, out);
      });
}

DUET_WIDEST void sample_glossy(int n, const RoughConductorSurface& surface,
                               const WideVertices& vertices, WideGlossy& out) {
  with_facets(
      surface.conductor.microfacet, [&]<class Facets>() __attribute__((always_inline)) {
        sample_all<Facets>(n, surface, vertices, out);
      });
}

DUET_WIDEST void reverse_glossy(int n, const RoughConductorSurface& surface,
                                const WideVertices& vertices, WideGlossy& out) {
  with_facets(
      surface.conductor.microfacet, [&]<class Facets>() __attribute__((always_inline)) {
        reverse_all<Facets>(n, surface, vertices, out);
      });
}

}  // namespace duet
