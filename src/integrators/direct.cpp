#include "integrators/direct.h"

#include "integrators/next_event.h"

namespace duet {

namespace {
constexpr uint32_t kDimensionsPerSample = 4;
}

Spectrum DirectIntegrator::radiance(const Scene& scene, const CameraPath& start, Sampler& sampler,
                                    RenderCounters& counters, std::span<float> values) const {
  const int lights = options_.emitter_samples, bsdfs = options_.bsdf_samples;
  const SampleShares shares{float(lights), float(bsdfs)};
  const Ray ray = options_.hide_emitters ? behind_emitters(scene, start.ray, counters) : start.ray;
  Hit hit;
  ++counters.closest_rays;
  if (!scene.accel->closest_hit(ray, hit)) {
    if (options_.hide_emitters || !scene.environment) return {};
    values[3] = 1;
    return weighted_environment(scene, ray.origin, ray.direction, std::nullopt, shares);
  }
  ++counters.path_vertices;
  values[3] = 1;
  const Surface s = scene.surface(ray, hit);
  Spectrum sum =
      weighted_emission(scene, s, {ray.origin, ray.direction, hit.t}, std::nullopt, shares);
  const Bsdf bsdf = scene.materials[s.shape->material]->bind(s, -ray.direction);
  uint32_t dimension = kFirstVertexDimension;
  if (bsdf.has_smooth() && !scene.lights.empty())
    for (int i = 0; i < lights; ++i) {
      sampler.start_dimension(dimension);
      dimension += kDimensionsPerSample;
      sum += sample_light(scene, s, bsdf, {options_.strict_normals, shares}, sampler, counters) *
             (1 / float(lights));
    }
  for (int i = 0; i < bsdfs; ++i) {
    sampler.start_dimension(dimension);
    dimension += kDimensionsPerSample;
    const Point2f v = sampler.next_2d();
    const auto sample = bsdf.sample(sampler.next_1d(), v, Transport::radiance);
    if (!sample || (options_.strict_normals && sides_differ(s, sample->wi))) continue;
    // Without light samples there is nothing to weigh against.
    const std::optional<PdfW> pdf =
        sample->delta || lights == 0 ? std::nullopt : std::optional(sample->pdf);
    const Ray next = spawn_ray(s, sample->wi);
    ++counters.closest_rays;
    Spectrum light;
    if (scene.accel->closest_hit(next, hit))
      light = weighted_emission(scene, scene.surface(next, hit),
                                {lit_point(scene, s), next.direction, hit.t}, pdf, shares);
    else
      light = weighted_environment(scene, lit_point(scene, s), next.direction, pdf, shares);
    sum += sample->weight * light * (1 / float(bsdfs));
  }
  return sum;
}

}  // namespace duet
