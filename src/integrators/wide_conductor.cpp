#include "integrators/wide_conductor.h"

namespace duet {

namespace {

/// The conductor at a point: as its index is the same everywhere, only the reflectance differs.
[[gnu::always_inline]] inline RoughConductorModel model_at(RoughConductorModel conductor,
                                                           const WidePoints& points, int i) {
  conductor.specular_reflectance = reflectance_at(points, i);
  return conductor;
}

/// RoughConductorModel::eval() at points of the surface, for evaluate_points() and
/// reverse_points().
template <class Use>
[[gnu::always_inline]] inline void with_eval(const RoughConductorSurface& surface,
                                             const WidePoints& points, const Use& use) {
  with_facets(
      surface.conductor.microfacet, [&]<class Facets>() __attribute__((always_inline)) {
        const RoughConductorModel conductor = surface.conductor;
        const Facets facets(conductor.microfacet);
        use([&](int i, const Vector3f& wo, const Vector3f& wi) __attribute__((always_inline)) {
          const Microfacet::Reflection r = facets.reflection(above_horizon(wo), above_horizon(wi));
          const Spectrum reflected = model_at(conductor, points, i).by_index(r.cosine) * r.value;
          return if_above(wo, wi, {reflected, r.density});
        });
      });
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

}  // namespace

DUET_WIDEST void evaluate_glossy(int n, const RoughConductorSurface& surface,
                                 const WideVertices& vertices, WideGlossy& out) {
  with_eval(
      surface, vertices.points, [&](const auto& eval) __attribute__((always_inline)) {
        evaluate_points(n, surface.two_sided, vertices, out, eval);
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
  with_eval(
      surface, vertices.points, [&](const auto& eval) __attribute__((always_inline)) {
        reverse_points(n, surface.two_sided, vertices, out, eval);
      });
}

}  // namespace duet
