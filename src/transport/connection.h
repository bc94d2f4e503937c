// What the two ends of a path have in common: how light found by an eye sub-path, sampled from one
// of its vertices, or brought by a light sub-path becomes a weighted contribution. Shadow rays come
// last.
//
// Vertices are PathVertex or MediaVertex. Where there are media densities count their nominal
// transmittance.
//
// `Weights` decides how a connection is weighed against the other techniques:
//   hit(subpath, direct, emission, light_sample)
//                                    s = 0; densities of the light's two other techniques
//   light_sample(eye, direct, bsdf, eye_end)
//                                    s = 1; densities of sampling and of hitting the light
//   camera(light, light_end)         t = 1
//   connection(light, light_end, eye, eye_end)
//   merge(light, light_reverse, eye, eye_reverse)
#pragma once

#include "math/hash.h"
#include "transport/light_choice.h"
#include "transport/light_starts.h"
#include "transport/light_vertex.h"
#include "transport/media_vertex.h"

namespace duet {

/// Spares connections that would add next to nothing their shadow ray: one that contributes c is
/// kept with probability min(1, c / threshold) and then counts for more.
class ConnectionRoulette {
 public:
  /// `key` seeds the decisions; a threshold of zero keeps everything.
  ConnectionRoulette(float threshold, uint64_t key) : threshold_(threshold), key_(seed_of(key)) {}
  /// 0 to drop the contribution, or what it is to be multiplied by. Numbers of connections
  /// (event()) tell those of one key apart: in whatever order they are asked for, the decisions are
  /// the same.
  float keep(const Spectrum& contribution, uint32_t connection) const {
    return keep(contribution.max(), threshold_, draw(key_, connection));
  }

  /// The number of the connection of two vertices, each given by its segments from its end, of
  /// which several may be drawn. Numbers of very long paths may be the same.
  static uint32_t event(int light_depth, int eye_depth, int drawn = 0) {
    return uint32_t(light_depth) + (uint32_t(eye_depth) << 12) + (uint32_t(drawn) << 24);
  }
  /// What keep() is made of, for many keys at once.
  static uint32_t seed_of(uint64_t key) { return uint32_t(mix64(key) >> 32); }
  [[gnu::always_inline]] static float draw(uint32_t seed, uint32_t connection) {
    return to_unit_float(mix32(seed + connection * 0x9e3779b9u));
  }
  [[gnu::always_inline]] static float keep(float contribution, float threshold, float drawn) {
    const float kept = drawn * threshold < contribution ? threshold / contribution : 0.0f;
    return contribution < threshold ? kept : 1.0f;
  }

 private:
  float threshold_;
  uint32_t key_;
};

/// Whether anything but a light lies on the ray: what blocks the view if emitters are hidden.
inline bool occluded_by_others(const Scene& scene, Ray ray, RenderCounters& counters) {
  for (;;) {
    Hit hit;
    ++counters.shadow_rays;
    if (!scene.accel->closest_hit(ray, hit)) return false;
    if (scene.shapes[hit.shape].light == kNone) return true;
    ray = beyond_hit(scene, ray, hit);
  }
}

/// A way from the light to the lens: its estimate without weight, and its weight.
struct Connection {
  Spectrum value;
  float weight = 0;
};

/// What all that is connected with the vertices of one sub-path needs.
template <class Weights>
struct ConnectionContext {
  const Scene& scene;
  LightStarts starts;
  const Weights& weights;
  const ConnectionRoulette& roulette;
  RenderCounters& counters;
  bool strict_normals = false;
  RandomStream* random = nullptr;  ///< for shadow rays through media; null where there are none
};

/// The light at the end of an eye sub-path that has hit the surface point `s` at squared distance
/// `d2` from its last vertex. `transmittance` is the nominal one on the way from there. `depth`
/// counts the segments, or is 0 where light samples count for one.
template <class Weights>
inline Connection connect_hit(const ConnectionContext<Weights>& c, const Subpath& subpath,
                              const Surface& s, float d2, int depth, float transmittance = 1) {
  const SurfaceLight* light = c.scene.light_on(*s.shape);
  if (!light) return {};
  const Spectrum emitted = light->emitted(s, -subpath.ray.direction);
  if (emitted.is_black()) return {};
  const Vector3f& w = subpath.ray.direction;
  const float choice = c.scene.direct_picker.probability(s.shape->light, subpath.from);
  const float direct = light->pdf_direct(subpath.from, s, w, d2).value * choice;
  const float emission =
      c.starts.density(s.shape->light, light->emission_density(s, -w), w, s.position);
  LightSampleVariance light_sample;
  if (depth == 2) light_sample = LightSampleVariance::of(false, true, choice, d2);
  return {subpath.throughput * emitted,
          c.weights.hit(subpath, direct / transmittance, emission, light_sample)};
}

/// The environment at the end of an eye sub-path that has left the scene.
template <class Weights>
inline Connection connect_escape(const ConnectionContext<Weights>& c, const Subpath& subpath,
                                 float transmittance = 1) {
  const Scene& scene = c.scene;
  const Vector3f& w = subpath.ray.direction;
  const Spectrum emitted = scene.environment->emitted(subpath.from, w);
  if (emitted.is_black()) return {};
  const float direct = choice_density(scene, subpath.from, w);
  const float emission = c.starts.density(scene.environment_index,
                                          scene.environment->emission_density(w), w, subpath.from);
  return {subpath.throughput * emitted,
          c.weights.hit(subpath, direct / transmittance, emission, {})};
}

/// A light sample from an eye vertex. Uses up to three dimensions of the sampler.
template <class Weights, class Vertex>
inline Connection connect_light(const ConnectionContext<Weights>& c, const Vertex& eye,
                                Sampler& sampler) {
  const Scene& scene = c.scene;
  const auto [sample, probability, light] = choose_light(scene, eye.position(), sampler);
  if (!sample || (c.strict_normals && eye.has_two_sides(sample->wi))) return {};
  const BsdfEval f = eye.eval(sample->wi, Transport::radiance);
  if (f.value.is_black()) return {};
  float direct = sample->pdf.value;
  if (sample->delta)
    direct = sample->finite ? length_squared(sample->target - eye.position()) : 1.0f;
  const float hit = sample->delta ? 0.0f : f.pdf.value;
  direct *= probability;
  const float emission = c.starts.density(light, sample->emission, sample->wi, eye.position());
  ConnectionEnd eye_end{emission * eye.cosine(sample->wi) / direct,
                        eye.reverse_pdf(sample->wi, Transport::radiance)};
  eye_end.merges = eye.merges(f.pdf.value, eye_end.beyond);
  if (!Vertex::kMedia && eye.depth == 1)
    eye_end.light_sample = LightSampleVariance::of(sample->delta, sample->finite, probability,
                                                   length_squared(sample->target - eye.position()));
  Connection connection{eye.throughput * f.value * sample->weight * (1 / probability),
                        c.weights.light_sample(eye, direct, hit, eye_end)};
  const float kept = c.roulette.keep(connection.value * connection.weight,
                                     ConnectionRoulette::event(0, eye.depth));
  if (kept == 0) return {};
  connection.value *= kept;
  if constexpr (Vertex::kMedia) {
    const Point3f origin = eye.outside(sample->wi);
    const auto transmittance = pass_through_media(
        scene, sample->finite ? ray_to(origin, sample->target) : Ray{origin, sample->wi, INFINITY},
        eye.medium_towards(scene, sample->wi), *c.random, c.counters);
    if (!transmittance) return {};
    connection.value *= transmittance->value;
    eye_end.arrival *= transmittance->nominal;
    connection.weight = c.weights.light_sample(eye, direct, hit * transmittance->nominal, eye_end);
  } else {
    const Ray shadow = sample->finite ? spawn_ray_to(eye.surface, sample->target)
                                      : spawn_ray(eye.surface, sample->wi);
    ++c.counters.shadow_rays;
    if (scene.accel->occluded(shadow)) return {};
  }
  return connection;
}

/// Where a light vertex is seen, and how bright it makes that place if the image is a function per
/// pixel area and one light sub-path is traced.
struct CameraConnection {
  Point2f film;
  Connection connection;
};

/// The weight of a light vertex seen at a film position, which only few weights ask for.
template <class Weights, class Vertex>
inline float camera_weight(const Weights& weights, const Vertex& light,
                           const ConnectionEnd& light_end, const Point2f& film) {
  if constexpr (requires { weights.camera(light, light_end, film); })
    return weights.camera(light, light_end, film);
  else
    return weights.camera(light, light_end);
}

/// What lies between the camera and a vertex where there are media; empty if the vertex cannot be
/// seen. Light is followed as eye sub-paths follow it, from the camera.
inline std::optional<Transmittance> seen_through_media(const Scene& scene, const MediaVertex& v,
                                                       const CameraSample& seen, bool hide_emitters,
                                                       RandomStream& random,
                                                       RenderCounters& counters) {
  Ray ray = ray_to(seen.target, v.outside(seen.direction));
  if (hide_emitters) {
    ray = behind_emitters(scene, ray, counters);
    // Behind surfaces that light passes straight lights are surfaces like others.
    if (!v.in_medium && v.surface.shape->light != kNone &&
        !(++counters.shadow_rays, scene.accel->occluded(ray)))
      return std::nullopt;
  }
  return pass_through_media(scene, ray, scene.camera_medium, random, counters);
}

/// A light vertex seen through a point of the lens; empty if it is not.
template <class Weights, class Vertex>
inline std::optional<CameraConnection> connect_camera(const ConnectionContext<Weights>& c,
                                                      const Vertex& light, const Point2f& lens,
                                                      bool hide_emitters) {
  const Scene& scene = c.scene;
  if constexpr (!Vertex::kMedia)
    if (hide_emitters && light.surface.shape->light != kNone) return std::nullopt;
  const auto seen = scene.camera->sample_lens(light.position(), lens);
  if (!seen) return std::nullopt;
  const BsdfPair f = light.eval_both_ways(seen->direction, Transport::importance);
  if (f.value.is_black()) return std::nullopt;
  const float adjoint = light.adjoint(seen->direction);
  if (!(adjoint > 0)) return std::nullopt;
  ConnectionEnd light_end{seen->importance * light.cosine(seen->direction), f.reverse.value,
                          light.merges(f.pdf.value, f.reverse.value), light.light_sample};
  Connection connection{light.throughput * f.value * (adjoint * seen->importance),
                        camera_weight(c.weights, light, light_end, seen->film)};
  const float kept = c.roulette.keep(connection.value * connection.weight,
                                     ConnectionRoulette::event(light.depth, 0));
  if (kept == 0) return std::nullopt;
  connection.value *= kept;
  if constexpr (Vertex::kMedia) {
    const auto transmittance =
        seen_through_media(scene, light, *seen, hide_emitters, *c.random, c.counters);
    if (!transmittance) return std::nullopt;
    connection.value *= transmittance->value;
    light_end.arrival *= transmittance->nominal;
    connection.weight = camera_weight(c.weights, light, light_end, seen->film);
  } else {
    const Ray ray = spawn_ray_to(light.surface, seen->target);
    if (hide_emitters ? occluded_by_others(scene, ray, c.counters)
                      : (++c.counters.shadow_rays, scene.accel->occluded(ray)))
      return std::nullopt;
  }
  return CameraConnection{seen->film, connection};
}

/// A light vertex and an eye vertex that light each other unless something lies between them.
struct EndsConnection {
  Connection connection;
  Vector3f to_light;  ///< unit
  Point3f target;     ///< of the shadow ray
  ConnectionEnd light_end, eye_end;
};

/// What a light vertex and an eye vertex contribute if they see each other; empty if nothing.
/// `drawn` tells connections of the same two ends apart, each of which counts `scale` times.
template <class Weights, class Vertex>
inline std::optional<EndsConnection> weigh_ends(const ConnectionContext<Weights>& c,
                                                const Vertex& light, const Vertex& eye,
                                                int drawn = 0, float scale = 1) {
  ConnectionCounters& counters = c.counters.connections;
  const auto fails = [](uint64_t& reason) {
    ++reason;
    return std::optional<EndsConnection>();
  };
  const Vector3f d = light.position() - eye.position();
  const float d2 = length_squared(d);
  if (!(d2 > 0)) return fails(counters.failed_zero);
  const Vector3f to_light = d * (1 / std::sqrt(d2));
  if (c.strict_normals && eye.has_two_sides(to_light)) return fails(counters.failed_zero);
  const BsdfPair f = eye.eval_both_ways(to_light, Transport::radiance);
  if (f.value.is_black()) return fails(counters.failed_zero);
  const BsdfPair g = light.eval_both_ways(-to_light, Transport::importance);
  if (g.value.is_black()) return fails(counters.failed_zero);
  const float adjoint = light.adjoint(-to_light);
  if (!(adjoint > 0)) return fails(counters.failed_zero);
  const float inverse_d2 = 1 / d2;
  const ConnectionEnd light_end{f.pdf.value * light.cosine(to_light) * inverse_d2, g.reverse.value,
                                light.merges(g.pdf.value, g.reverse.value)};
  const ConnectionEnd eye_end{g.pdf.value * eye.cosine(to_light) * inverse_d2, f.reverse.value,
                              eye.merges(f.pdf.value, f.reverse.value)};
  Connection connection{
      eye.throughput * f.value * light.throughput * g.value * (adjoint * inverse_d2 * scale),
      c.weights.connection(light, light_end, eye, eye_end)};
  const float kept = c.roulette.keep(connection.value * connection.weight,
                                     ConnectionRoulette::event(light.depth, eye.depth, drawn));
  if (kept == 0) return fails(counters.skipped);
  connection.value *= kept;
  return EndsConnection{connection, to_light, light.outside(-to_light), light_end, eye_end};
}

/// A light vertex seen from an eye vertex.
template <class Weights, class Vertex>
inline Connection connect_ends(const ConnectionContext<Weights>& c, const Vertex& light,
                               const Vertex& eye, int drawn = 0, float scale = 1) {
  std::optional<EndsConnection> ends = weigh_ends(c, light, eye, drawn, scale);
  if (!ends) return {};
  ConnectionCounters& counters = c.counters.connections;
  const auto fails = [&] {
    ++counters.failed_occluded;
    return Connection{};
  };
  Connection& connection = ends->connection;
  if constexpr (Vertex::kMedia) {
    const auto transmittance =
        pass_through_media(c.scene, ray_to(eye.outside(ends->to_light), ends->target),
                           eye.medium_towards(c.scene, ends->to_light), *c.random, c.counters);
    if (!transmittance) return fails();
    connection.value *= transmittance->value;
    ends->light_end.arrival *= transmittance->nominal;
    ends->eye_end.arrival *= transmittance->nominal;
    connection.weight = c.weights.connection(light, ends->light_end, eye, ends->eye_end);
  } else {
    ++c.counters.shadow_rays;
    if (c.scene.accel->occluded(spawn_ray_to(eye.surface, ends->target))) return fails();
  }
  ++counters.contributed;
  return connection;
}

/// A light vertex near an eye vertex, taken for the same point. `kernel` is the weight of the
/// photon: one over the disk's area and the number of light sub-paths.
template <class Weights>
inline Connection connect_merge(const Weights& weights, const LightVertex& light,
                                const PathVertex& eye, float kernel, bool strict_normals) {
  const Vector3f wi = light.direction_to_previous();
  if (strict_normals && sides_differ(eye.surface, wi)) return {};
  const BsdfPair f = eye.bsdf.eval_both_ways(wi, Transport::radiance);
  if (f.value.is_black() || !eye.merges(f.pdf.value, f.reverse.value)) return {};
  return {eye.throughput * f.value * light.arriving * kernel,
          weights.merge(light, f.pdf.value, eye, f.reverse.value)};
}

}  // namespace duet
