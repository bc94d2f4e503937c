// One random walk for both sides: from vertex to vertex, with the sums of multiple importance
// sampling carried along.
#pragma once

#include "math/sampler.h"
#include "transport/counters.h"
#include "transport/path_vertex.h"
#include "transport/roulette.h"
#include "transport/trail.h"

namespace duet {

struct WalkOptions {
  int rr_depth = 5;  ///< segments before roulette begins
  bool strict_normals = false;
};

/// A walk between two vertices.
struct Walk {
  Ray ray;                    ///< to the next vertex
  Spectrum throughput;        ///< on arrival there
  Partials partials{};        ///< on leaving the last one
  float carried = 1;          ///< product of what scattering has left, without what refraction adds
  Point3f from{};             ///< the last vertex
  bool from_specular = true;  ///< it was left by a delta lobe, or is on the lens
  float cosine_out = 1;       ///< |cos| with which the last vertex was left
  bool unmerged = true;       ///< nothing so far could have been merged (Bsdf::merges())
  float forward = 0;          ///< density per solid angle of the ray
  Trail* trail = nullptr;     ///< filled if not null
};

/// Records the arrival of a walk at a vertex; `d2` and `cosine` as in arrive().
inline void record_arrival(Walk& walk, float d2, float cosine) {
  if (!walk.trail) return;
  walk.trail->push_back({walk.forward * cosine / d2, 0, walk.cosine_out / d2, false});
}

/// Where and how a walk arrives at a vertex.
struct Arrival {
  Point3f at;
  float d2;                 ///< squared distance from the last vertex
  float cosine;             ///< geometric; in a medium the extinction in its place
  float transmittance = 1;  ///< the nominal one on the way from there
};

/// The sums at the first vertex of an eye walk, where light tracing competes. `camera_ray` starts
/// at the camera, which the walk's ray may not do.
inline Partials first_eye_partials(const Scene& scene, const Ray& camera_ray, const Arrival& a,
                                   const TechniqueSet& set, Walk& walk) {
  const float importance = scene.camera->importance(camera_ray, distance(a.at, camera_ray.origin));
  walk.forward = importance * a.d2;
  Partials p;
  if (set.camera_joins)
    p.vcm = set.light_paths / (set.connection_share * importance * a.cosine * a.transmittance);
  return p;
}

/// Records that the last vertex was left, by which the one before learns its reverse density.
inline void record_departure(Walk& walk, float reverse, bool specular, bool merges) {
  if (!walk.trail) return;
  Trail& trail = *walk.trail;
  trail.back().specular = specular, trail.back().merges = merges;
  if (trail.size() > 1) trail[trail.size() - 2].reverse = reverse * trail.back().back;
}

/// Whether a walk goes on from a vertex `depth` segments from its start; its throughput then makes
/// up for those that end.
inline bool survives(int depth, const WalkOptions& options, Sampler& sampler, Walk& walk) {
  if (depth < options.rr_depth) return true;
  // Relative to what the walk began with: the same for dim and for bright lights.
  const float survival = russian_roulette(walk.carried, sampler);
  if (survival == 0) return false;
  walk.throughput *= 1 / survival;
  walk.carried /= survival;
  return true;
}

/// Chooses where a walk goes on from a surface; see scatter(). With `passes` one that goes straight
/// on stays the walk that had not come to the surface yet, but for ray and throughput.
template <Transport transport, bool passes>
inline bool scatter_on_surface(const PathVertex& v, const TechniqueSet& set,
                               const WalkOptions& options, Sampler& sampler, Walk& walk,
                               bool* passed_straight) {
  const Point2f direction = sampler.next_2d();
  const float choice = v.bsdf.needs_choice() ? sampler.next_1d() : 0.5f;
  const auto s = v.bsdf.sample(choice, direction, transport);
  if (passed_straight) *passed_straight = s && s->null;
  if (!s) return false;
  constexpr bool to_light = transport == Transport::radiance;
  // Strictness is about the direction towards the light, whoever walks.
  if (options.strict_normals && sides_differ(v.surface, to_light ? s->wi : v.wo)) return false;
  Spectrum weight = s->weight;
  if (!to_light) weight *= adjoint_factor(v.surface, v.wo, s->wi);
  walk.throughput = v.throughput * weight;
  walk.carried *= weight.max();
  if (to_light) walk.carried *= s->eta * s->eta;
  if (!(walk.throughput.max() > 0)) return false;
  if (passes && s->null) {
    walk.ray = spawn_ray(v.surface, s->wi);
    if (walk.trail) walk.trail->pop_back();
    return true;
  }
  if (!survives(v.depth, options, sampler, walk)) return false;
  const float cosine_out = v.cosine(s->wi);
  if (s->delta) {
    const float in = std::abs(dot(v.surface.shading.n, v.wo)),
                out = std::abs(dot(v.surface.shading.n, s->wi));
    const float jacobian = s->eta == 1 ? 1.0f : in / (out * s->eta * s->eta);
    walk.partials = leave_specular(v.partials, cosine_out, jacobian);
    walk.forward = 1;
    record_departure(walk, jacobian, true, false);
  } else {
    const float reverse = v.bsdf.reverse_pdf(s->wi, transport).value;
    const bool merges = v.merges(s->pdf.value, reverse);
    walk.partials = leave(v.partials, {s->pdf.value, reverse, cosine_out}, set, merges);
    walk.forward = s->pdf.value;
    walk.unmerged &= !merges;
    record_departure(walk, reverse, false, merges);
  }
  walk.cosine_out = cosine_out;
  walk.from = v.position();
  walk.from_specular = s->delta;
  walk.ray = spawn_ray(v.surface, s->wi);
  return true;
}

/// Chooses where a walk goes on from a vertex; false if it ends. Uses up to four dimensions of the
/// sampler. The roulette divides the throughput and is left out of all densities.
template <Transport transport>
inline bool scatter(const PathVertex& v, const TechniqueSet& set, const WalkOptions& options,
                    Sampler& sampler, Walk& walk, bool* passed_straight = nullptr) {
  return scatter_on_surface<transport, false>(v, set, options, sampler, walk, passed_straight);
}

}  // namespace duet
