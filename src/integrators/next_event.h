// Light that reaches a surface point straight from a light: by choosing a point of the light, or by
// a ray that happens to find it.
#pragma once

#include "integrators/integrator.h"
#include "transport/light_choice.h"
#include "transport/shadow_transmittance.h"

namespace duet {

/// How many samples of each kind the heuristic weighs against one another, in any common unit.
struct SampleShares {
  float light = 1, bsdf = 1;
};

/// How next event estimation samples.
struct NextEventOptions {
  bool strict_normals = false;
  SampleShares shares{};
};

/// A ray as it arrives at a surface point.
struct ArrivingRay {
  Point3f from;        ///< the last vertex
  Vector3f direction;  ///< of unit length
  float t;             ///< the distance
};

/// Whether a shape is lit beside its points: see lit_point().
inline bool is_lit_beside(const Scene& scene, const Shape& shape) {
  return shape.kind == ShapeKind::curves && shape.curves->profile != CurveProfile::tube &&
         !scene.materials[shape.material]->transmits();
}

/// Where the light at a surface point is looked up. A ribbon of curves faces every ray, so one that
/// starts on it would meet it again: like pbrt, an opaque one is lit where rays are clear of it.
inline Point3f lit_point(const Scene& scene, const Surface& s) {
  return is_lit_beside(scene, *s.shape) ? offset_position(s, Vector3f(s.ng)) : s.position;
}

/// Weight of a sample with density a where b could have made it too.
/// Source: Veach 1997, section 9.2.4, the power heuristic with exponent 2.
[[gnu::always_inline]] inline float power_heuristic(float a, float b) {
  const float ratio = b / a;
  return a > 0 ? 1 / (1 + ratio * ratio) : 0.0f;
}

/// Next event estimation at a surface point: radiance towards the Bsdf's wo that comes straight
/// from one chosen light, weighted against BSDF sampling. Uses up to three dimensions of the
/// sampler. The scene must have a light. `B` is Bsdf
/// or PlainDiffuse.
template <class B>
inline Spectrum sample_light(const Scene& scene, const Surface& s, const B& bsdf,
                             const NextEventOptions& options, Sampler& sampler,
                             RenderCounters& counters) {
  const SampleShares& shares = options.shares;
  const ChosenLight chosen = choose_light(scene, lit_point(scene, s), sampler);
  const std::optional<LightSample>& light = chosen.sample;
  if (!light || (options.strict_normals && sides_differ(s, light->wi))) return {};
  const BsdfEval f = bsdf.eval(light->wi, Transport::radiance);
  if (f.value.is_black()) return {};
  const Ray shadow = light->finite ? spawn_ray_to(s, light->target) : spawn_ray(s, light->wi);
  ++counters.shadow_rays;
  if (scene.accel->occluded(shadow)) return {};
  const float weight = light->delta
                           ? 1.0f
                           : power_heuristic(light->pdf.value * chosen.probability * shares.light,
                                             f.pdf.value * shares.bsdf);
  return f.value * light->weight * (weight / chosen.probability);
}

/// Emission of the surface that a ray has met, weighted against next event estimation. `bsdf_pdf`
/// made the direction; nothing if it was a delta lobe or the camera, which light samples cannot
/// compete with.
inline Spectrum weighted_emission(const Scene& scene, const Surface& s, const ArrivingRay& ray,
                                  std::optional<PdfW> bsdf_pdf, const SampleShares& shares) {
  const SurfaceLight* light = scene.light_on(*s.shape);
  if (!light) return {};
  const Spectrum emitted = light->emitted(s, -ray.direction);
  if (!bsdf_pdf || emitted.is_black()) return emitted;
  const float pdf = choice_density(scene, *light, ray.from, s, ray.direction, ray.t * ray.t);
  return emitted * power_heuristic(bsdf_pdf->value * shares.bsdf, pdf * shares.light);
}

/// The same for a ray from `from` that has left the scene in the direction `w`.
inline Spectrum weighted_environment(const Scene& scene, const Point3f& from, const Vector3f& w,
                                     std::optional<PdfW> bsdf_pdf, const SampleShares& shares) {
  if (!scene.environment) return {};
  const Spectrum emitted = scene.environment->emitted(from, w);
  if (!bsdf_pdf) return emitted;
  const float pdf = choice_density(scene, from, w);
  return emitted * power_heuristic(bsdf_pdf->value * shares.bsdf, pdf * shares.light);
}

}  // namespace duet
