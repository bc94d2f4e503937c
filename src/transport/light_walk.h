// Walks that start at a light.
#pragma once

#include "transport/walk.h"

namespace duet {

/// Random numbers set aside for the start of a walk (choice of the light, position, direction) and
/// for each of its vertices (direction, lobe, roulette, point on the lens).
inline constexpr uint32_t kLightStartDimensions = 6;
inline constexpr uint32_t kLightVertexDimensions = 6;
/// Of these, where the point on the lens is.
inline constexpr uint32_t kLensOffset = 4;

/// A walk that has left its light.
struct LightStart {
  Walk walk;
  const Light* light;
  float pick_probability;
  EmissionSample emission;

  /// Density of the ray as in EmissionSample::density.
  float density() const { return emission.density * pick_probability; }
  /// Density per solid angle with which a light sample at `at` finds the start of the ray.
  float direct(const Point3f& at) const {
    return light->direct_density(emission, at) * pick_probability;
  }
};

/// Empty if the ray carries nothing.
inline std::optional<LightStart> start_light_walk(const Scene& scene, Sampler& sampler) {
  const float choice = sampler.next_1d();
  const Point2f position = sampler.next_2d(), direction = sampler.next_2d();
  const LightPicker::Pick pick = scene.picker.pick(choice);
  const Light& light = *scene.lights[pick.light];
  const auto e = light.sample_emission(position, direction);
  if (!e || !(pick.probability > 0)) return std::nullopt;
  LightStart start;
  start.walk.ray = e->ray;
  start.walk.throughput = e->weight * (1 / pick.probability);
  start.light = &light;
  start.pick_probability = pick.probability;
  start.emission = *e;
  return start;
}

/// The sums at the first vertex of a light walk, at which light samples and rays that find the
/// light compete.
inline Partials first_light_partials(const LightStart& start, const Point3f& at, float cosine,
                                     const TechniqueSet& set) {
  const float scale = 1 / (start.density() * cosine * set.connection_share);
  Partials p;
  p.vcm = start.direct(at) * scale;
  p.vc = is_delta(start.light->kind()) ? 0.0f : scale;
  p.vm = p.vc * set.connection_term();
  return p;
}

/// The beginning of a light walk's trail. What would be densities per area of the light are per
/// solid angle at the first vertex instead, which spares distances and cosines that cancel:
/// `back` of vertex 0 is that of light samples, and `forward` of vertex 1 that of both vertices.
inline void record_first_arrival(const LightStart& start, const Point3f& at, float cosine) {
  Trail* trail = start.walk.trail;
  if (!trail) return;
  trail->push_back({1, 0, start.direct(at), is_delta(start.light->kind())});
  trail->push_back({start.density() * cosine, 0, 1, false});
}

/// Traces one walk of up to `max_depth` segments. `visit(vertex, hit)` sees every vertex. Returns
/// the number of vertices.
template <class Visit>
int trace_light_walk(const Scene& scene, const TechniqueSet& set, const WalkOptions& options,
                     int max_depth, Sampler& sampler, RenderCounters& counters, Trail* trail,
                     Visit&& visit) {
  ++counters.light_paths;
  sampler.start_dimension(0);
  auto start = start_light_walk(scene, sampler);
  if (trail) trail->clear();
  if (!start) return 0;
  Walk& walk = start->walk;
  walk.trail = trail;
  for (int depth = 1; depth <= max_depth; ++depth) {
    Hit hit;
    ++counters.closest_rays;
    if (!scene.accel->closest_hit(walk.ray, hit)) return depth - 1;
    const Surface s = scene.surface(walk.ray, hit);
    const float cosine = std::abs(dot(s.ng, walk.ray.direction));
    if (!(cosine > 0)) return depth - 1;
    Partials partials;
    if (depth == 1) {
      partials = first_light_partials(*start, s.position, cosine, set);
      record_first_arrival(*start, s.position, cosine);
    } else {
      partials = arrive(walk.partials, hit.t * hit.t, cosine);
      record_arrival(walk, hit.t * hit.t, cosine);
    }
    const PathVertex v(scene, s, -walk.ray.direction, walk.throughput, partials, depth);
    visit(v, hit);
    if (depth == max_depth) return depth;
    sampler.start_dimension(kLightStartDimensions + kLightVertexDimensions * uint32_t(depth - 1));
    if (!scatter<Transport::importance>(v, set, options, sampler, walk)) return depth;
  }
  return max_depth;
}

}  // namespace duet
