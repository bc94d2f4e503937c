#include "integrators/wide_principled.h"

namespace duet {

namespace {

/// PrincipledModel::eval() without a clear coat: of directions below the horizon zero.
[[gnu::always_inline]] inline ModelEval evaluate(PrincipledModel model, const Spectrum& base_color,
                                                 const PrincipledModel::Choice& pick,
                                                 const Vector3f& wo, const Vector3f& wi) {
  model.base_color = base_color;
  model.tint = tint_of(base_color);
  const Vector3f o = above_horizon(wo), i = above_horizon(wi);
  return if_above(wo, wi,
                  model.eval_uncoated(o, i, model.facets.visible_ggx_reflection(o, i), pick));
}

/// The same at points of the surface, for evaluate_points() and reverse_points().
template <class Use>
[[gnu::always_inline]] inline void with_eval(const PrincipledSurface& surface,
                                             const WidePoints& points, const Use& use) {
  const PrincipledModel model = surface.model;
  const PrincipledModel::Choice pick = model.choice();
  use([&](int i, const Vector3f& wo, const Vector3f& wi) __attribute__((always_inline)) {
    return evaluate(model, reflectance_at(points, i), pick, wo, wi);
  });
}

}  // namespace

DUET_WIDEST void evaluate_glossy(int n, const PrincipledSurface& surface,
                                 const WideVertices& vertices, WideGlossy& out) {
  with_eval(
      surface, vertices.points, [&](const auto& eval) __attribute__((always_inline)) {
        evaluate_points(n, surface.two_sided, vertices, out, eval);
      });
}

DUET_WIDEST void sample_glossy(int n, const PrincipledSurface& surface,
                               const WideVertices& vertices, WideGlossy& out) {
  const PrincipledModel model = surface.model;
  const PrincipledModel::Choice pick = model.choice();
  const bool two_sided = surface.two_sided;
  const WideVertices vs = vertices;
  DUET_LANES
  for (int k = 0; k < n; ++k) {
    const int i = out.at[k];
    const LocalPoint at = local_point(vs, i, two_sided);
    const float u = vs.numbers.first[i];
    const Point2f v{vs.numbers.x[i], vs.numbers.y[i]};
    const Vector3f mirrored = reflect(at.wo, model.facets.sample_visible_ggx(at.wo, v));
    const Vector3f diffuse = square_to_cosine_hemisphere(v);
    const bool is_diffuse = u < pick.diffuse;
    const Vector3f wi(is_diffuse ? diffuse.x : mirrored.x, is_diffuse ? diffuse.y : mirrored.y,
                      is_diffuse ? diffuse.z : mirrored.z);
    const ModelEval e = evaluate(model, reflectance_at(vs.points, i), pick, at.wo, wi);
    const Spectrum weight = e.value / e.pdf;
    out.wi.set(k, at.to_world(wi));
    out.weight.set(k, weight.r, weight.g, weight.b);
    out.pdf[k] = e.pdf;
    out.roulette[k] = vs.numbers.second[i];
    out.alive[k] = e.pdf > 0 ? 1 : 0;
  }
}

DUET_WIDEST void reverse_glossy(int n, const PrincipledSurface& surface,
                                const WideVertices& vertices, WideGlossy& out) {
  with_eval(
      surface, vertices.points, [&](const auto& eval) __attribute__((always_inline)) {
        reverse_points(n, surface.two_sided, vertices, out, eval);
      });
}

}  // namespace duet
