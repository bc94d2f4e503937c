#include "integrators/wide_dielectric.h"

#include "base/instruction_sets.h"

namespace duet {

namespace {

template <class Facets>
[[gnu::always_inline]] inline void evaluate_all(int n, const RoughDielectricModel& model,
                                                const WideVertices& vertices, WideGlossy& out) {
  const RoughDielectricModel dielectric = model;
  const Facets facets(dielectric.microfacet);
  const WideVertices v = vertices;
  DUET_LANES
  for (int k = 0; k < n; ++k) {
    const LocalPoint at = local_point(v, out.at[k], false);
    const ModelEval e =
        dielectric.eval_by(facets, at.wo, at.to_local(out.towards.vector(k)), v.transport);
    out.value.set(k, e.value.r, e.value.g, e.value.b);
    out.value_pdf[k] = e.pdf;
  }
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

template <class Facets>
[[gnu::always_inline]] inline void reverse_all(int n, const RoughDielectricModel& model,
                                               const WideVertices& vertices, WideGlossy& out) {
  const RoughDielectricModel dielectric = model;
  const Facets facets(dielectric.microfacet);
  const WideVertices v = vertices;
  DUET_LANES
  for (int k = 0; k < n; ++k) {
    const LocalPoint at = local_point(v, out.at[k], false);
    const Vector3f wi = at.to_local(out.towards.vector(k));
    out.reverse[k] = dielectric.eval_by(facets, wi, at.wo, v.transport).pdf;
  }
}

}  // namespace

DUET_WIDEST void evaluate_glossy(int n, const RoughDielectricSurface& surface,
                                 const WideVertices& vertices, WideGlossy& out) {
  with_facets(
      surface.dielectric.microfacet, [&]<class Facets>() __attribute__((always_inline)) {
        evaluate_all<Facets>(n, surface.dielectric, vertices, out);
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
  with_facets(
      surface.dielectric.microfacet, [&]<class Facets>() __attribute__((always_inline)) {
        reverse_all<Facets>(n, surface.dielectric, vertices, out);
      });
}

}  // namespace duet
