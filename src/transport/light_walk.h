// Walks that start at a light.
#pragma once

#include "scene/light_media.h"
#include "transport/media_vertex.h"

namespace duet {

/// Random numbers set aside for the start of a walk (choice of the light, position, direction) and
/// for each of its vertices (direction, lobe, roulette, point on the lens).
inline constexpr uint32_t kLightStartDimensions = 6;
inline constexpr uint32_t kLightVertexDimensions = 6;
/// Of these, where the point on the lens is.
inline constexpr uint32_t kLensOffset = 4;
/// Where there are media the way to a vertex needs one more, the last.
template <class Vertex>
inline constexpr uint32_t kLightVertexStride = kLightVertexDimensions + (Vertex::kMedia ? 1 : 0);

/// A walk that has left its light.
struct LightStart {
  Walk walk;
  const Light* light;
  uint32_t index;  ///< of the light
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
  const LightPicker::Pick pick = scene.picker.pick(choice, position);
  const Light& light = *scene.lights[pick.light];
  const auto e = light.sample_emission(position, direction);
  if (!e || !(pick.probability > 0)) return std::nullopt;
  LightStart start;
  start.walk.ray = e->ray;
  start.walk.throughput = e->weight * (1 / pick.probability);
  start.light = &light;
  start.index = pick.light;
  start.pick_probability = pick.probability;
  start.emission = *e;
  return start;
}

/// The sums at the first vertex of a light walk, at which light samples and rays that find the
/// light compete. `transmittance` is the nominal one from the light.
inline Partials first_light_partials(const LightStart& start, const Point3f& at, float cosine,
                                     const TechniqueSet& set, float transmittance = 1) {
  const float scale = 1 / (start.density() * cosine * set.connection_share);
  Partials p;
  p.vcm = start.direct(at) * scale / transmittance;
  p.vc = is_delta(start.light->kind()) ? 0.0f : scale;
  p.vm = p.vc * set.walk_connection_term();
  return p;
}

/// The beginning of a light walk's trail. What would be densities per area of the light are per
/// solid angle at the first vertex instead, which spares distances and cosines that cancel:
/// `back` of vertex 0 is that of light samples, and `forward` of vertex 1 that of both vertices.
inline void record_first_arrival(const LightStart& start, const Point3f& at, float cosine,
                                 Trail* trail, float transmittance = 1) {
  if (!trail) return;
  trail->clear();
  trail->push_back({1, 0, start.direct(at), is_delta(start.light->kind())});
  trail->push_back({start.density() * cosine * transmittance, 0, transmittance, false});
}

/// The walk that has left the light, for the kind of vertices that it is to have. `seed` is for
/// what happens in media.
template <class Vertex>
inline WalkOf<Vertex> leave_light(const Scene& scene, const LightStart& start, uint64_t seed) {
  if constexpr (Vertex::kMedia) {
    const Medium* medium =
        medium_at_emission(scene, scene.light_media[start.index], start.walk.ray.origin);
    MediaWalk walk(scene, start.walk, medium, seed);
    if (medium && is_infinite(start.light->kind())) {
      // The medium goes on behind the start of the ray, up to where the light is.
      Ray back = start.walk.ray;
      back.direction = -back.direction, back.tmax = INFINITY;
      SpectralWeights w;
      medium->transmit(back, walk.random, w);
      walk.throughput *= w.value;
      walk.transmittance = medium->nominal_transmittance(back);
    }
    return walk;
  } else {
    return start.walk;
  }
}

/// Traces one walk of up to `max_depth` segments. `visit(vertex, hit)` sees every vertex, on
/// surfaces where they were hit, and finds the sampler at the random numbers for the lens. Returns
/// the number of vertices. `Vertex` is PathVertex or, with a `seed`, MediaVertex.
template <class Vertex = PathVertex, class Visit>
int trace_light_walk(const Scene& scene, const TechniqueSet& set, const WalkOptions& options,
                     int max_depth, Sampler& sampler, RenderCounters& counters, Trail* trail,
                     Visit&& visit, uint64_t seed = 0) {
  ++counters.light_paths;
  sampler.start_dimension(0);
  const auto start = start_light_walk(scene, sampler);
  if (trail) trail->clear();
  if (!start) return 0;
  WalkOf<Vertex> walk = leave_light<Vertex>(scene, *start, seed);
  walk.trail = trail;
  int depth = 1;
  uint32_t dimension = kLightStartDimensions;
  const auto arrive_at = [&](const Point3f& p, float d2, float cosine, float transmittance) {
    if (depth == 1) {
      record_first_arrival(*start, p, cosine, trail, transmittance);
      return first_light_partials(*start, p, cosine, set, transmittance);
    }
    record_arrival(walk, d2 / transmittance, cosine);
    return arrive(walk.partials, d2 / transmittance, cosine, set.walk_connections());
  };
  /// Whether the walk goes on behind the vertex.
  const auto pass = [&](const Vertex& v, const Hit& hit, bool may_be_passed) {
    sampler.start_dimension(dimension + kLensOffset);
    visit(v, hit);
    if (depth == max_depth && !may_be_passed) return false;
    sampler.start_dimension(dimension);
    dimension += kLightVertexStride<Vertex>;
    bool straight = false;
    if (!scatter<Transport::importance>(v, set, options, sampler, walk, &straight)) return false;
    if (Vertex::kMedia && straight) return true;
    return depth++ < max_depth;
  };
  if (max_depth < 1) return 0;
  for (;;) {
    Hit hit;
    ++counters.closest_rays;
    const bool found = scene.accel->closest_hit(walk.ray, hit);
    if constexpr (Vertex::kMedia) {
      if (walk.medium) {
        Ray segment = walk.ray;
        if (found) segment.tmax = hit.t;
        sampler.start_dimension(dimension + kLightVertexDimensions);
        const float t = walk.cross(segment, sampler.next_1d(), counters);
        if (t < INFINITY) {
          const Point3f p = walk.ray.origin + walk.ray.direction * t;
          const float d2 = depth == 1 ? 1.0f : length_squared(p - walk.from);
          const float extinction = walk.medium->nominal_extinction(p);
          if (!(d2 > 0 && extinction > 0)) return depth - 1;
          const Partials partials = arrive_at(p, d2, extinction, walk.counted_transmittance());
          const Vertex v(*walk.medium, extinction, p, -walk.ray.direction, walk.throughput,
                         partials, depth);
          if (!pass(v, hit, false)) return depth;
          continue;
        }
      }
    }
    if (!found) return depth - 1;
    const Surface s = scene.surface(walk.ray, hit);
    const float cosine = std::abs(dot(s.ng, walk.ray.direction));
    if (!(cosine > 0)) return depth - 1;
    if constexpr (Vertex::kMedia) {
      const float d2 = depth == 1 ? 1.0f : length_squared(s.position - walk.from);
      const Partials partials = arrive_at(s.position, d2, cosine, walk.counted_transmittance());
      const Vertex v(scene, s, -walk.ray.direction, walk.throughput, partials, depth, walk.medium);
      if (!pass(v, hit, scene.materials[s.shape->material]->passes_straight())) return depth;
    } else {
      const Partials partials = arrive_at(s.position, hit.t * hit.t, cosine, 1);
      const Vertex v(scene, s, -walk.ray.direction, walk.throughput, partials, depth);
      if (!pass(v, hit, false)) return depth;
    }
  }
}

}  // namespace duet
