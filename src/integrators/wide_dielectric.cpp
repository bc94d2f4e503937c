#include "integrators/wide_dielectric.h"

namespace duet {

namespace {

/// RoughDielectricModel::eval() for evaluate_points() and reverse_points().
template <class Use>
[[gnu::always_inline]] inline void with_eval(const RoughDielectricSurface& surface,
                                             Transport transport, const Use& use) {
  with_facets(
      surface.dielectric.microfacet, [&]<class Facets>() __attribute__((always_inline)) {
        const RoughDielectricModel dielectric = surface.dielectric;
        const Facets facets(dielectric.microfacet);
        use([&](int, const Vector3f& wo, const Vector3f& wi) __attribute__((always_inline)) {
          return dielectric.eval_by(facets, wo, wi, transport);
        });
      });
}

template <class Facets>
[[gnu::always_inline]] inline void sample_all(int n, const RoughDielectricModel& model,
                                              const WideVertices& vertices, WideGlossy& out) {
  const RoughDielectricModel dielectric = model;
  const Facets facets(dielectric.microfacet);
  const WideVertices v = vertices;
  const bool scales_roulette = v.transport == Transport::radiance;
  DUET_LANES
  for (int k = 0; k < n; ++k) {
    const int i = out.at[k];
    const LocalPoint at = local_point(v, i, false);
    const BranchFreeSample s = dielectric.sample_by(facets, at.wo, v.numbers.first[i],
                                                    {v.numbers.x[i], v.numbers.y[i]}, v.transport);
    out.wi.set(k, at.to_world(s.wi));
    out.weight.set(k, s.weight.r, s.weight.g, s.weight.b);
    out.pdf[k] = s.pdf;
    out.eta[k] = scales_roulette ? s.eta : 1.0f;
    out.roulette[k] = v.numbers.second[i];
    out.alive[k] = s.carries;
  }
}

}  // namespace

DUET_WIDEST void evaluate_glossy(int n, const RoughDielectricSurface& surface,
                                 const WideVertices& vertices, WideGlossy& out) {
  with_eval(
      surface, vertices.transport, [&](const auto& eval) __attribute__((always_inline)) {
        evaluate_points(n, false, vertices, out, eval);
      });
}

DUET_WIDEST void sample_glossy(int n, const RoughDielectricSurface& surface,
                               const WideVertices& vertices, WideGlossy& out) {
  with_facets(
      surface.dielectric.microfacet, [&]<class Facets>() __attribute__((always_inline)) {
        sample_all<Facets>(n, surface.dielectric, vertices, out);
      });
}

DUET_WIDEST void reverse_glossy(int n, const RoughDielectricSurface& surface,
                                const WideVertices& vertices, WideGlossy& out) {
  with_eval(
      surface, vertices.transport, [&](const auto& eval) __attribute__((always_inline)) {
        reverse_points(n, false, vertices, out, eval);
      });
}

}  // namespace duet
