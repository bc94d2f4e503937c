#include "integrators/wide_plastic.h"

namespace duet {

namespace {

/// RoughPlasticModel::eval(): of directions below the horizon zero.
template <class Facets>
[[gnu::always_inline]] inline ModelEval evaluate(const RoughPlasticModel& model,
                                                 const Facets& facets, const Vector3f& wo,
                                                 const Vector3f& wi) {
  const Vector3f o = above_horizon(wo), i = above_horizon(wi);
  const Microfacet::Reflection r = facets.reflection(o, i);
  return if_above(wo, wi, model.eval_above(o, i, r, dielectric_reflectance(r.cosine, model.eta)));
}

/// A plastic of one roughness, whose table is never blended: compilers have to see that.
[[gnu::always_inline]] inline UniformRoughPlastic lanes_of(const RoughPlasticSurface& surface) {
  UniformRoughPlastic plastic = surface.plastic;
  plastic.transmittance = plastic.transmittance.first();
  return plastic;
}

/// The same at points of the surface, for evaluate_points() and reverse_points().
template <class Use>
[[gnu::always_inline]] inline void with_eval(const RoughPlasticSurface& surface,
                                             const WidePoints& points, const Use& use) {
  with_facets(
      surface.plastic.microfacet, [&]<class Facets>() __attribute__((always_inline)) {
        const UniformRoughPlastic plastic = lanes_of(surface);
        const Facets facets(plastic.microfacet);
        use([&](int i, const Vector3f& wo, const Vector3f& wi) __attribute__((always_inline)) {
          return evaluate(plastic.model(reflectance_at(points, i)), facets, wo, wi);
        });
      });
}

/// PlasticModel::eval() likewise.
template <class Use>
[[gnu::always_inline]] inline void with_eval(const PlasticSurface& surface,
                                             const WidePoints& points, const Use& use) {
  const UniformPlastic plastic = surface.plastic;
  use([&](int i, const Vector3f& wo, const Vector3f& wi) __attribute__((always_inline)) {
    const ModelEval e =
        plastic.model(reflectance_at(points, i)).eval_above(above_horizon(wo), above_horizon(wi));
    const bool above = std::min(wo.z, wi.z) > 0;
    return ModelEval{{above ? e.value.r : 0, above ? e.value.g : 0, above ? e.value.b : 0},
                     above ? e.pdf : 0};
  });
}

template <class Facets>
[[gnu::always_inline]] inline void sample_all(int n, const RoughPlasticSurface& surface,
                                              const WideVertices& vertices, WideGlossy& out) {
  const UniformRoughPlastic plastic = lanes_of(surface);
  const Facets facets(plastic.microfacet);
  const bool two_sided = surface.two_sided;
  const WideVertices vs = vertices;
  const TransmittanceRow transmittance = plastic.transmittance;
  const float specular_weight = plastic.specular_reflectance.mean();
  DUET_LANES
  for (int k = 0; k < n; ++k) {
    const int i = out.at[k];
    const LocalPoint at = local_point(vs, i, two_sided);
    const Spectrum base = reflectance_at(vs.points, i);
    const float diffuse_weight = base.mean();
    const float first = vs.numbers.first[i], second = vs.numbers.second[i];
    // See RoughPlasticModel::needs_choice(): the coat reflects in any case.
    const float u = diffuse_weight > 0 ? first : 0.5f;
    out.roulette[k] = diffuse_weight > 0 ? second : first;
    const float p =
        lobe_probability(1 - transmittance(std::abs(at.wo.z)), specular_weight, diffuse_weight);
    const Point2f v{vs.numbers.x[i], vs.numbers.y[i]};
    const Vector3f mirrored = reflect(at.wo, facets.sample(at.wo, v));
    const Vector3f diffuse = square_to_cosine_hemisphere(v);
    const Vector3f wi(u < p ? mirrored.x : diffuse.x, u < p ? mirrored.y : diffuse.y,
                      u < p ? mirrored.z : diffuse.z);
    const ModelEval e = evaluate(plastic.model(base), facets, at.wo, wi);
    const Spectrum weight = e.value / e.pdf;
    out.wi.set(k, at.to_world(wi));
    out.weight.set(k, weight.r, weight.g, weight.b);
    out.pdf[k] = e.pdf;
    out.alive[k] = e.pdf > 0 ? 1 : 0;
  }
}

/// Of directions whose cosines are not above `horizon` zero.
template <class Model>
[[gnu::always_inline]] inline void see_all(int n, const Model& model, float horizon,
                                           const float* cosines, float* factors) {
  DUET_LANES
  for (int k = 0; k < n; ++k) {
    const float cosine = cosines[k] > horizon ? cosines[k] : 0.0f;  // also what is no number
    const float seen = model.seen_through_coat(cosine);
    factors[k] = cosine > 0 ? seen : 0;
  }
}

}  // namespace

DUET_WIDEST void evaluate_glossy(int n, const RoughPlasticSurface& surface,
                                 const WideVertices& vertices, WideGlossy& out) {
  with_eval(
      surface, vertices.points, [&](const auto& eval) __attribute__((always_inline)) {
        evaluate_points(n, surface.two_sided, vertices, out, eval);
      });
}

DUET_WIDEST void sample_glossy(int n, const RoughPlasticSurface& surface,
                               const WideVertices& vertices, WideGlossy& out) {
  with_facets(
      surface.plastic.microfacet, [&]<class Facets>() __attribute__((always_inline)) {
        sample_all<Facets>(n, surface, vertices, out);
      });
}

DUET_WIDEST void reverse_glossy(int n, const RoughPlasticSurface& surface,
                                const WideVertices& vertices, WideGlossy& out) {
  with_eval(
      surface, vertices.points, [&](const auto& eval) __attribute__((always_inline)) {
        reverse_points(n, surface.two_sided, vertices, out, eval);
      });
}

DUET_WIDEST void see_bases(int n, const RoughPlasticSurface& surface, const float* cosines,
                           float* factors) {
  see_all(n, lanes_of(surface).model(Spectrum(0.0f)), kMinCosine, cosines, factors);
}

DUET_WIDEST void evaluate_glossy(int n, const PlasticSurface& surface, const WideVertices& vertices,
                                 WideGlossy& out) {
  with_eval(
      surface, vertices.points, [&](const auto& eval) __attribute__((always_inline)) {
        evaluate_points(n, surface.two_sided, vertices, out, eval);
      });
}

DUET_WIDEST void sample_glossy(int n, const PlasticSurface& surface, const WideVertices& vertices,
                               WideGlossy& out) {
  const UniformPlastic plastic = surface.plastic;
  const bool two_sided = surface.two_sided;
  const WideVertices v = vertices;
  DUET_LANES
  for (int k = 0; k < n; ++k) {
    const int i = out.at[k];
    const LocalPoint at = local_point(v, i, two_sided);
    const PlasticModel model = plastic.model(reflectance_at(v.points, i));
    const float first = v.numbers.first[i], second = v.numbers.second[i];
    // See PlasticModel::needs_choice(): the coat reflects in any case.
    const bool chooses = model.diffuse_weight > 0;
    const BranchFreeSample s = model.sample_branch_free(
        at.wo, chooses ? first : 0.5f, {v.numbers.x[i], v.numbers.y[i]}, Transport::radiance);
    out.roulette[k] = chooses ? second : first;
    out.wi.set(k, at.to_world(s.wi));
    out.weight.set(k, s.weight.r, s.weight.g, s.weight.b);
    out.pdf[k] = s.delta != 0 ? -1.0f : s.pdf;
    out.alive[k] = s.carries;
  }
}

DUET_WIDEST void reverse_glossy(int n, const PlasticSurface& surface, const WideVertices& vertices,
                                WideGlossy& out) {
  with_eval(
      surface, vertices.points, [&](const auto& eval) __attribute__((always_inline)) {
        reverse_points(n, surface.two_sided, vertices, out, eval);
      });
}

DUET_WIDEST void see_bases(int n, const PlasticSurface& surface, const float* cosines,
                           float* factors) {
  see_all(n, surface.plastic.model(Spectrum(0.0f)), 0, cosines, factors);
}

}  // namespace duet
