#include "integrators/path.h"

#include "integrators/next_event.h"

namespace duet {

namespace {

/// Random numbers set aside for each vertex: direction to and choice of the light, direction and
/// lobe of the BSDF, roulette.
constexpr uint32_t kDimensionsPerVertex = 8;
constexpr uint32_t kBsdfDimension = 4;

}  // namespace

Spectrum PathIntegrator::radiance(const Scene& scene, const Ray& camera_ray, Sampler& sampler,
                                  RenderCounters& counters, float& alpha) const {
  if (options_.max_depth == 0) return {};
  const SampleShares shares;
  Ray ray = options_.hide_emitters ? behind_emitters(scene, camera_ray, counters) : camera_ray;
  Spectrum sum, throughput(1);
  std::optional<PdfW> bsdf_pdf;  // of the last direction, if light samples compete with it
  Point3f from = ray.origin;
  float eta = 1;  // relative index of refraction along the path
  for (int depth = 1;; ++depth) {
    Hit hit;
    ++counters.closest_rays;
    if (!scene.accel->closest_hit(ray, hit)) {
      if (depth == 1 && options_.hide_emitters) break;
      sum += throughput * weighted_environment(scene, ray.direction, bsdf_pdf, shares);
      if (scene.environment) alpha = 1;
      break;
    }
    ++counters.path_vertices;
    const Surface s = scene.surface(ray, hit);
    if (s.shape->light != kNone)
      sum += throughput * weighted_emission(scene, s, from, ray.direction, hit.t, bsdf_pdf, shares);
    if (depth == options_.max_depth) {
      alpha = 1;
      break;
    }
    const Bsdf bsdf = scene.materials[s.shape->material]->bind(s, -ray.direction);
    const uint32_t dimension = kFirstVertexDimension + kDimensionsPerVertex * uint32_t(depth - 1);
    if (bsdf.has_smooth() && scene.picker.size() > 0) {
      sampler.start_dimension(dimension);
      sum += throughput *
             sample_light(scene, s, bsdf, options_.strict_normals, shares, sampler, counters);
    }
    sampler.start_dimension(dimension + kBsdfDimension);
    const Point2f v = sampler.next_2d();
    const float u = bsdf.needs_choice() ? sampler.next_1d() : 0.5f;
    const auto sample = bsdf.sample(u, v, Transport::radiance);
    if (!sample || !sample->null) alpha = 1;
    if (!sample || (options_.strict_normals && sides_differ(s, sample->wi))) break;
    throughput *= sample->weight;
    const float importance = throughput.max();
    if (!(importance > 0)) break;
    eta *= sample->eta;
    if (depth >= options_.rr_depth) {
      // Where light is refracted into a denser medium its radiance grows without carrying more.
      const float survival = std::min(importance * eta * eta, 0.95f);
      if (!(sampler.next_1d() < survival)) break;
      throughput *= 1 / survival;
    }
    if (sample->delta)
      bsdf_pdf.reset();
    else
      bsdf_pdf = sample->pdf;
    from = s.position;
    ray = spawn_ray(s, sample->wi);
  }
  return sum;
}

}  // namespace duet
