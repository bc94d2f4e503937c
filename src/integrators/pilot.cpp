#include "integrators/pilot.h"

#include <algorithm>
#include <cmath>
#include <mutex>

namespace duet {

namespace {

constexpr uint32_t kPilotSubpaths = 4096;
/// Keeps the pilot's random numbers apart from those of the image.
constexpr uint32_t kPilotScramble = 0x70696c6fu;
/// The pilot is the same for all images of a scene, whichever of them a method renders first.
constexpr uint64_t kPilotSeed = 0;
/// Rays per side of the image, and specular bounces that they follow.
constexpr int kRays = 32, kBounces = 8;

/// The side of a pixel where a camera ray meets the first surface that is not specular; zero if
/// there is none.
double footprint(const Scene& scene, const Ray& camera_ray, Sampler& sampler) {
  Ray ray = camera_ray;
  float distance = 0;
  for (int i = 0; i < kBounces; ++i) {
    Hit hit;
    if (!scene.accel->closest_hit(ray, hit)) return 0;
    distance += hit.t;
    const Surface s = scene.surface(ray, hit);
    const Bsdf bsdf = scene.materials[s.shape->material]->bind(s, -ray.direction);
    if (bsdf.has_smooth())
      return std::sqrt(1 / double(scene.camera->importance(camera_ray, distance)));
    const auto next = bsdf.sample(sampler.next_1d(), sampler.next_2d(), Transport::radiance);
    if (!next) return 0;
    ray = spawn_ray(s, next->wi);
  }
  return 0;
}

}  // namespace

double pixel_footprint(const Scene& scene, Point2i film) {
  std::vector<double> sizes;
  for (int y = 0; y < kRays; ++y)
    for (int x = 0; x < kRays; ++x) {
      Sampler sampler(SampleSequence::independent, kPilotSeed, kPilotScramble,
                      uint64_t(y * kRays + x));
      sampler.start_sample(0);
      const Point2f film_position{(float(x) + 0.5f) / kRays * float(film.x),
                                  (float(y) + 0.5f) / kRays * float(film.y)};
      const Ray ray = scene.camera->sample_ray(film_position, sampler.next_2d());
      const double size = footprint(scene, ray, sampler);
      if (size > 0 && std::isfinite(size)) sizes.push_back(size);
    }
  if (sizes.empty()) return 1e-3 * std::max(1e-6, double(scene.accel->bounds().radius()));
  const auto middle = sizes.begin() + ptrdiff_t(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle;
}

Pilot run_pilot(const Scene& scene, Point2i film, LightPassPlan plan) {
  Pilot pilot;
  pilot.footprint = pixel_footprint(scene, film);
  plan.subpaths = kPilotSubpaths;
  plan.seed = kPilotSeed;
  plan.scramble = kPilotScramble;
  plan.iteration = 0;
  plan.set.camera_connections = plan.unit_weights = true;
  plan.keep_vertices = true;
  plan.windows = nullptr;
  LightPass lights;
  RenderCounters counters;
  ExactSum light;
  std::mutex lock;
  const auto measure = [&](std::span<const LightSplat> splats, RenderCounters&) {
    const std::lock_guard guard(lock);
    for (const LightSplat& s : splats)
      if (film_can_add(s.splat.value)) light.add(double(s.splat.value.max()));
  };
  if (!scene.lights.empty()) lights.run(scene, plan, measure, counters);
  pilot.brightness = light.value() / kPilotSubpaths / (double(film.x) * double(film.y));
  pilot.vertices_per_subpath = double(lights.vertices().vertices.size()) / kPilotSubpaths;
  return pilot;
}

}  // namespace duet
