#include "integrators/wide_plastic.h"

#include "base/instruction_sets.h"
#include "math/frame.h"
#include "math/warp.h"

namespace duet {

namespace {

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

[[gnu::always_inline]] inline LocalPoint local_point(const WidePaths& paths,
                                                     const WidePoints& points, int i,
                                                     bool two_sided) {
  return {points.ns.normal(i), -paths.ray.direction.vector(i), two_sided};
}

[[gnu::always_inline]] inline Spectrum base_at(const WidePoints& points, int i) {
  return {points.reflectance.x[i], points.reflectance.y[i], points.reflectance.z[i]};
}

/// RoughPlasticModel::eval(): of directions below the horizon zero.
[[gnu::always_inline]] inline ModelEval evaluate(const RoughPlasticModel& model,
                                                 const Microfacet& facets, const Vector3f& wo,
                                                 const Vector3f& wi) {
  const Vector3f o(wo.x, wo.y, std::abs(wo.z)), i(wi.x, wi.y, std::abs(wi.z));
  const Microfacet::Reflection r = facets.visible_ggx_reflection(o, i);
  const ModelEval e = model.eval_above(o, i, r, dielectric_reflectance(r.cosine, model.eta));
  const bool above = std::min(wo.z, wi.z) > kMinCosine;
  return {{above ? e.value.r : 0, above ? e.value.g : 0, above ? e.value.b : 0}, above ? e.pdf : 0};
}

/// A plastic of one roughness, whose table is never blended: compilers have to see that.
[[gnu::always_inline]] inline UniformRoughPlastic lanes_of(const RoughPlasticSurface& surface) {
  UniformRoughPlastic plastic = surface.plastic;
  plastic.transmittance = plastic.transmittance.first();
  return plastic;
}

}  // namespace

DUET_WIDEST void evaluate_plastic(int n, const RoughPlasticSurface& surface,
                                  const WideVertices& vertices, const BatchTriples& light,
                                  WidePlastics& out) {
  const UniformRoughPlastic plastic = lanes_of(surface);
  const Microfacet facets = plastic.microfacet;
  const bool two_sided = surface.two_sided;
  const WidePaths& paths = vertices.paths;
  const WidePoints& points = vertices.points;
  DUET_LANES
  for (int k = 0; k < n; ++k) {
    const int i = out.at[k];
    const LocalPoint at = local_point(paths, points, i, two_sided);
    const ModelEval e =
        evaluate(plastic.model(base_at(points, i)), facets, at.wo, at.to_local(light.vector(i)));
    out.value.set(k, e.value.r, e.value.g, e.value.b);
    out.value_pdf[k] = e.pdf;
  }
}

DUET_WIDEST void sample_plastic(int n, const RoughPlasticSurface& surface,
                                const WideVertices& vertices, WidePlastics& out) {
  const UniformRoughPlastic plastic = lanes_of(surface);
  const Microfacet facets = plastic.microfacet;
  const bool two_sided = surface.two_sided;
  const WidePaths& paths = vertices.paths;
  const WidePoints& points = vertices.points;
  const WideNumbers& numbers = vertices.numbers;
  const TransmittanceRow transmittance = plastic.transmittance;
  const float specular_weight = plastic.specular_reflectance.mean();
  DUET_LANES
  for (int k = 0; k < n; ++k) {
    const int i = out.at[k];
    const LocalPoint at = local_point(paths, points, i, two_sided);
    const Spectrum base = base_at(points, i);
    const float diffuse_weight = base.mean();
    const float first = numbers.first[i], second = numbers.second[i];
    // See RoughPlasticModel::needs_choice(): the coat reflects in any case.
    const float u = diffuse_weight > 0 ? first : 0.5f;
    out.roulette[k] = diffuse_weight > 0 ? second : first;
    const float p =
        lobe_probability(1 - transmittance(std::abs(at.wo.z)), specular_weight, diffuse_weight);
    const Point2f v(numbers.x[i], numbers.y[i]);
    const Vector3f mirrored = reflect(at.wo, facets.sample_visible_ggx(at.wo, v));
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

}  // namespace duet
