#include "integrators/specular_layers.h"

#include "integrators/vertex_sample.h"

namespace duet {

namespace {

/// Between mirrors there would be no end. What is left then counts as white.
constexpr uint32_t kMostReflections = 16;

}  // namespace

SpecularView follow_specular(const Scene& scene, const Ray& ray, const Surface& first,
                             Sampler& sampler, RenderCounters& counters) {
  Surface s = first;
  Vector3f wo = -ray.direction;
  Spectrum throughput(1);
  for (uint32_t vertex = 0;; ++vertex) {
    const Material& material = *scene.materials[s.shape->material];
    if (vertex == kMostReflections) return {throughput, s.shading.n};
    const Bsdf bsdf = material.bind(s, wo);
    const auto sample = sample_vertex(bsdf, vertex, sampler);
    if (!sample) return {Spectrum(), s.shading.n};
    // The mean of the weights is the share of the light that is scattered at all. Radiance grows in
    // a denser medium without carrying more.
    throughput *= sample->weight * (sample->eta * sample->eta);
    // What shines through a coat, or beside a reflection, is the surface's own colour.
    if (!sample->null && (bsdf.has_smooth() || !sample->delta)) return {throughput, s.shading.n};
    const Ray next = spawn_ray(s, sample->wi);
    Hit hit;
    ++counters.closest_rays;
    if (!scene.accel->closest_hit(next, hit)) return {};
    s = scene.surface(next, hit);
    wo = -next.direction;
  }
}

}  // namespace duet
