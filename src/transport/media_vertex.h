// Sub-paths and their vertices where there are media: light is scattered on surfaces and between
// them.
#pragma once

#include <algorithm>
#include <type_traits>

#include "transport/shadow_transmittance.h"
#include "transport/subpath.h"

namespace duet {

/// The factor by which densities count the way between two vertices is not allowed to vanish.
inline constexpr float kLeastTransmittance = 1e-6f;

/// A point of a medium at which light is scattered.
struct MediumPoint {
  const Medium& medium;
  float extinction;  ///< the nominal one there
  Point3f position;
};

/// What a sub-path brings to a vertex.
struct SubpathState {
  const Spectrum& throughput;
  const Partials& partials;
  int segments;  ///< from its start to here
};

/// A vertex on a surface or in a medium.
struct MediaVertex : PathVertex {
  static constexpr bool kMedia = true;

  const Medium* medium;  ///< what the previous segment went through, or null
  bool in_medium;
  float extinction = 0;  ///< the nominal one; in a medium only

  MediaVertex(const Scene& scene, const Surface& s, const Vector3f& towards_previous,
              const SubpathState& subpath, const Medium* through)
      : PathVertex(scene, s, towards_previous, subpath.throughput, subpath.partials,
                   subpath.segments),
        medium(through),
        in_medium(false) {}
  MediaVertex(const MediumPoint& where, const Vector3f& towards_previous,
              const SubpathState& subpath)
      : PathVertex(where.position, towards_previous, subpath.throughput, subpath.partials,
                   subpath.segments),
        medium(&where.medium),
        in_medium(true),
        extinction(where.extinction) {}

  /// What makes densities per solid angle densities per area, or per volume.
  float cosine(const Vector3f& w) const { return in_medium ? extinction : PathVertex::cosine(w); }
  bool is_smooth() const { return in_medium || PathVertex::is_smooth(); }
  bool merges() const { return !in_medium && PathVertex::merges(); }
  bool merges(float pdf, float reverse) const {
    return !in_medium && PathVertex::merges(pdf, reverse);
  }
  BsdfEval eval(const Vector3f& w, Transport transport) const {
    if (!in_medium) return PathVertex::eval(w, transport);
    const PdfW f = medium->phase().eval(position(), wo, w);
    return {Spectrum(f.value), f};
  }
  BsdfPair eval_both_ways(const Vector3f& w, Transport transport) const {
    if (!in_medium) return PathVertex::eval_both_ways(w, transport);
    const PdfW f = medium->phase().eval(position(), wo, w);
    return {Spectrum(f.value), f, medium->phase().eval(position(), w, wo)};
  }
  float reverse_pdf(const Vector3f& w, Transport transport) const {
    return in_medium ? medium->phase().eval(position(), w, wo).value
                     : PathVertex::reverse_pdf(w, transport);
  }
  float adjoint(const Vector3f& w) const { return in_medium ? 1.0f : PathVertex::adjoint(w); }
  bool has_two_sides(const Vector3f& w) const { return !in_medium && PathVertex::has_two_sides(w); }
  Point3f outside(const Vector3f& w) const {
    return in_medium ? position() : PathVertex::outside(w);
  }
  /// The medium that begins at the vertex towards `w`.
  const Medium* medium_towards(const Scene& scene, const Vector3f& w) const {
    return !in_medium && surface.shape->separates_media() ? scene.medium_beyond(surface, w)
                                                          : medium;
  }
};

/// A sub-path that may be scattered before it comes to a surface. Distances are sampled for one
/// colour channel, and what is carried has been weighed among the channels (SpectralWeights):
/// `channels` are their densities over the mean of the three. A surface that is passed straight is
/// no vertex.
struct MediaSubpath : Subpath {
  const Scene& scene;
  const Medium* medium;  ///< that the ray starts in
  RandomStream random;
  int channel;
  Spectrum channels{1};
  float transmittance = 1;  ///< nominal, of the way since the last vertex

  MediaSubpath(const Scene& s, const Subpath& subpath, const Medium* m, uint64_t seed)
      : Subpath(subpath),
        scene(s),
        medium(m),
        random(seed),
        channel(std::min(int(3 * random.next()), 2)) {}

  /// Goes along the ray up to ray.tmax. Returns the distance to where light is scattered, or
  /// INFINITY. `u` is a random number.
  float cross(const Ray& segment, float u, RenderCounters& counters) {
    if (!medium) return INFINITY;
    SpectralWeights w;
    w.value = throughput, w.pdf = channels, w.channel = channel;
    const RandomStream start = random;
    const float t = medium->sample_distance(segment, u, random, w);
    counters.medium_steps += 1 + random.drawn_since(start);
    const float scale = 1 / w.pdf.mean(), before = throughput.max();
    throughput = w.value * scale, channels = w.pdf * scale;
    carried *= throughput.max() / before;
    Ray passed = segment;
    passed.tmax = std::min(t, segment.tmax);
    transmittance *= medium->nominal_transmittance(passed);
    return t;
  }
  /// The same along the sub-path's own ray, up to the surface at distance `end` or INFINITY, with
  /// the random number of this dimension.
  float cross(float end, Sampler& sampler, uint32_t dimension, RenderCounters& counters) {
    if (!medium) return INFINITY;
    Ray segment = ray;
    segment.tmax = std::min(segment.tmax, end);
    sampler.start_dimension(dimension);
    return cross(segment, sampler.next_1d(), counters);
  }
  /// The transmittance as densities count it.
  float counted_transmittance() const { return std::max(transmittance, kLeastTransmittance); }
};

/// The sub-path that leads from vertex to vertex.
template <class Vertex>
using SubpathOf = std::conditional_t<Vertex::kMedia, MediaSubpath, Subpath>;

/// What a shadow ray lets through, and how much of it in densities.
struct Transmittance {
  Spectrum value{1};
  float nominal = 1;
};

/// Empty if the ray is blocked; as shadow_transmittance().
inline std::optional<Transmittance> pass_through_media(const Scene& scene, const Ray& ray,
                                                       const Medium* medium, RandomStream& random,
                                                       RenderCounters& counters) {
  SpectralWeights w;
  Transmittance transmittance;
  if (!shadow_transmittance(scene, {ray, medium}, random, w, counters, &transmittance.nominal))
    return std::nullopt;
  transmittance.value = w.value;
  transmittance.nominal = std::max(transmittance.nominal, kLeastTransmittance);
  return transmittance;
}

/// Chooses where a sub-path goes on from a point of a medium; see scatter().
template <Transport transport>
inline bool scatter_in_medium(const MediaVertex& v, const TechniqueSet& set,
                              const SubpathOptions& options, Sampler& sampler,
                              MediaSubpath& subpath) {
  const PhaseFunction& phase = v.medium->phase();
  const Point2f direction = sampler.next_2d();
  const PhaseSample s = phase.sample(v.position(), v.wo, sampler.next_1d(), direction);
  if (!(s.pdf.value > 0)) return false;
  subpath.throughput = v.throughput;
  if (!survives(v.depth, options, kMediaRoulette, sampler, subpath)) return false;
  const float reverse = phase.eval(v.position(), s.wi, v.wo).value;
  subpath.partials = leave(v.partials, {s.pdf.value, reverse, v.extinction}, set, false);
  subpath.forward = s.pdf.value;
  subpath.from_specular = false;
  record_departure(subpath, reverse, false, false);
  subpath.cosine_out = v.extinction;
  subpath.from = v.position();
  subpath.transmittance = 1;
  subpath.ray = {v.position(), s.wi, INFINITY};
  return true;
}

/// scatter() where there are media. If the surface was passed straight the sub-path goes on as if
/// it had not been there.
template <Transport transport>
inline bool scatter(const MediaVertex& v, const TechniqueSet& set, const SubpathOptions& options,
                    Sampler& sampler, MediaSubpath& subpath, bool* passed_straight) {
  if (v.in_medium) return scatter_in_medium<transport>(v, set, options, sampler, subpath);
  bool straight = false;
  if (!scatter_on_surface<transport, true>(v, set, options, sampler, subpath, &straight))
    return false;
  if (passed_straight) *passed_straight = straight;
  if (!straight) subpath.transmittance = 1;
  subpath.medium = v.medium_towards(subpath.scene, subpath.ray.direction);
  return true;
}

}  // namespace duet
