#include "integrators/wide_specular.h"

#include "base/instruction_sets.h"

namespace duet {

namespace {

template <class Model>
[[gnu::always_inline]] inline void sample_all(int n, const Model& delta, bool two_sided,
                                              const WideVertices& vertices, WideGlossy& out) {
  const Model model = delta;
  const WideVertices v = vertices;
  const bool scales_roulette = v.transport == Transport::radiance;
  const BatchArray<float>& roulette = model.needs_choice() ? v.numbers.second : v.numbers.first;
  DUET_LANES
  for (int k = 0; k < n; ++k) {
    const int i = out.at[k];
    const LocalPoint at = local_point(v, i, two_sided);
    const BranchFreeSample s = model.sample_branch_free(at.wo, v.numbers.first[i], {}, v.transport);
    out.wi.set(k, at.to_world(s.wi));
    out.weight.set(k, s.weight.r, s.weight.g, s.weight.b);
    out.pdf[k] = -1;
    // Sub-paths from the lights carry no more into a denser medium.
    out.eta[k] = scales_roulette ? s.eta : 1.0f;
    const float refracted = std::abs(at.wo.z / (s.wi.z * s.eta * s.eta));
    out.reverse[k] = s.eta == 1 ? 1.0f : refracted;
    out.roulette[k] = roulette[i];
    out.alive[k] = s.carries;
    out.null[k] = s.null;
  }
}

}  // namespace

DUET_WIDEST void sample_specular(int n, const SpecularSurface& surface,
                                 const WideVertices& vertices, WideGlossy& out) {
  if (const auto* glass = std::get_if<DielectricModel>(&surface.model))
    sample_all(n, *glass, surface.two_sided, vertices, out);
  else if (const auto* pane = std::get_if<ThinDielectricModel>(&surface.model))
    sample_all(n, *pane, surface.two_sided, vertices, out);
  else
    sample_all(n, std::get<ConductorModel>(surface.model), surface.two_sided, vertices, out);
}

}  // namespace duet
