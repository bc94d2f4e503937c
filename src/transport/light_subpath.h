// Sub-paths that start at a light.
#pragma once

#include "scene/light_media.h"
#include "transport/light_starts.h"
#include "transport/media_vertex.h"

namespace duet {

/// Random numbers set aside for the start of a sub-path (choice of the light, position, direction)
/// and for each of its vertices (direction, lobe, roulette, point on the lens).
inline constexpr uint32_t kLightStartDimensions = 6;
inline constexpr uint32_t kLightVertexDimensions = 6;
/// Of these, where the point on the lens is.
inline constexpr uint32_t kLensOffset = 4;
/// Where there are media the way to a vertex needs one more, the last.
template <class Vertex>
inline constexpr uint32_t kLightVertexStride = kLightVertexDimensions + (Vertex::kMedia ? 1 : 0);

/// How a light sample at the first vertex of a light sub-path finds the start of its ray.
struct StartByLightSample {
  float density = 0;  ///< per solid angle
  LightSampleVariance variance{};
};

/// A sub-path that has left its light.
struct LightStart {
  Subpath subpath;
  const Light* light;
  uint32_t index;  ///< of the light
  float pick_probability;
  const DirectPicker* direct_picker;  ///< of light samples
  EmissionSample emission;

  /// Density of the ray as in EmissionSample::density.
  float density() const { return emission.density * pick_probability; }
  StartByLightSample direct(const Point3f& at) const {
    const float choice = direct_picker->probability(index, at);
    return {light->direct_density(emission, at) * choice,
            LightSampleVariance::of(is_delta(light->kind()), !is_infinite(light->kind()), choice,
                                    length_squared(at - emission.ray.origin))};
  }
  /// Whether light samples at a first vertex find nothing, because the light has not entered yet.
  bool is_before_entry(const Point3f& p) const {
    return emission.entry > 0 &&
           dot(p - emission.ray.origin, emission.ray.direction) < emission.entry;
  }
};

/// The random numbers of a start.
struct LightStartNumbers {
  float choice;
  Point2f position, direction;
};

/// Empty if the ray carries nothing.
inline std::optional<LightStart> start_light_subpath(const Scene& scene, const LightStarts& starts,
                                                     const LightStartNumbers& u) {
  const auto& [choice, position, direction] = u;
  const LightPicker::Pick pick = starts.pick(choice, position);
  const auto e = starts.emit(pick.light, position, direction);
  if (!e || !(pick.probability > 0)) return std::nullopt;
  LightStart start;
  start.subpath.ray = e->ray;
  start.subpath.throughput = e->weight * (1 / pick.probability);
  start.light = scene.lights[pick.light].get();
  start.index = pick.light;
  start.pick_probability = pick.probability;
  start.direct_picker = &scene.direct_picker;
  start.emission = *e;
  return start;
}

/// The same of the numbers that the sampler has next.
inline std::optional<LightStart> start_light_subpath(const Scene& scene, const LightStarts& starts,
                                                     Sampler& sampler) {
  const float choice = sampler.next_1d();
  const Point2f position = sampler.next_2d(), direction = sampler.next_2d();
  return start_light_subpath(scene, starts, {choice, position, direction});
}

/// The sums at the first vertex of a light sub-path, at which light samples and rays that find the
/// light compete. `direct` is the density of the first, `transmittance` the nominal one from the
/// light.
inline Partials first_light_partials(const LightStart& start, float direct, float cosine,
                                     const TechniqueSet& set, float transmittance = 1) {
  const float scale = 1 / (start.density() * cosine * set.connection_share);
  Partials p;
  p.vcm = direct * scale / transmittance;
  p.vc = is_delta(start.light->kind()) ? 0.0f : scale;
  p.vm = p.vc * set.subpath_connection_term();
  return p;
}

/// The beginning of a light sub-path's vertex pdfs. What would be densities per area of the light
/// are per solid angle at the first vertex instead, which spares distances and cosines that cancel:
/// `back` of vertex 0 is that of light samples, and `forward` of vertex 1 that of both vertices.
inline void record_first_arrival(const LightStart& start, float direct, float cosine,
                                 SubpathPdfs* pdfs, float transmittance = 1) {
  if (!pdfs) return;
  pdfs->clear();
  pdfs->push_back({1, 0, direct, is_delta(start.light->kind())});
  pdfs->push_back({start.density() * cosine * transmittance, 0, transmittance, false});
}

/// The sub-path that has left the light, for the kind of vertices that it is to have. `seed` is for
/// what happens in media.
template <class Vertex>
inline SubpathOf<Vertex> leave_light(const Scene& scene, const LightStart& start, uint64_t seed) {
  if constexpr (Vertex::kMedia) {
    const Medium* medium =
        medium_at_emission(scene, scene.light_media[start.index], start.subpath.ray.origin);
    MediaSubpath subpath(scene, start.subpath, medium, seed);
    if (medium && is_infinite(start.light->kind())) {
      // The medium goes on behind the start of the ray, up to where the light is.
      Ray back = start.subpath.ray;
      back.direction = -back.direction, back.tmax = INFINITY;
      SpectralWeights w;
      medium->transmit(back, subpath.random, w);
      subpath.throughput *= w.value;
      subpath.transmittance = medium->nominal_transmittance(back);
    }
    return subpath;
  } else {
    return start.subpath;
  }
}

/// How a light sub-path is traced.
struct LightSubpathContext {
  const Scene& scene;
  const LightStarts& starts;
  const TechniqueSet& set;
  SubpathOptions options;
  int max_depth;  ///< segments that it has at most
  Sampler& sampler;
  RenderCounters& counters;
  SubpathPdfs* pdfs = nullptr;  ///< filled if not null
  uint64_t seed = 0;            ///< for what happens in media
};

/// A light sub-path under way; see trace_light_subpath().
template <class Vertex, class Visit>
class LightSubpath {
 public:
  LightSubpath(const LightSubpathContext& context, const LightStart& start, Visit& visit)
      : c_(context),
        start_(start),
        visit_(visit),
        subpath_(leave_light<Vertex>(context.scene, start, context.seed)) {
    subpath_.pdfs = context.pdfs;
  }

  int trace() {
    for (;;) {
      Hit hit;
      ++c_.counters.closest_rays;
      const bool found = c_.scene.accel->closest_hit(subpath_.ray, hit);
      if constexpr (Vertex::kMedia)
        if (const float t = subpath_.cross(found ? hit.t : INFINITY, c_.sampler,
                                           dimension_ + kLightVertexDimensions, c_.counters);
            t < INFINITY) {
          if (!scatter_between(t, hit)) return depth_ - missed_;
          continue;
        }
      if (!found) return depth_ - 1;
      if (!meet_surface(hit)) return depth_ - missed_;
    }
  }

 private:
  /// In a medium; whether the sub-path goes on.
  bool scatter_between(float t, const Hit& hit) {
    const Point3f p = subpath_.ray.origin + subpath_.ray.direction * t;
    const float d2 = distance2(p);
    const float extinction = subpath_.medium->nominal_extinction(p);
    if (!(d2 > 0 && extinction > 0)) return miss();
    const Partials partials = arrive_at({p, d2, extinction, subpath_.counted_transmittance()});
    const Vertex v({*subpath_.medium, extinction, p}, -subpath_.ray.direction,
                   {subpath_.throughput, partials, depth_});
    return pass(v, hit, false);
  }

  bool meet_surface(const Hit& hit) {
    const Surface s = c_.scene.surface(subpath_.ray, hit);
    const float cosine = std::abs(dot(s.ng, subpath_.ray.direction));
    if (!(cosine > 0)) return miss();
    if constexpr (Vertex::kMedia) {
      const Partials partials =
          arrive_at({s.position, distance2(s.position), cosine, subpath_.counted_transmittance()});
      const Vertex v(c_.scene, s, -subpath_.ray.direction, {subpath_.throughput, partials, depth_},
                     subpath_.medium);
      return pass(v, hit, c_.scene.materials[s.shape->material]->passes_straight());
    } else {
      const Partials partials = arrive_at({s.position, hit.t * hit.t, cosine});
      Vertex v(c_.scene, s, -subpath_.ray.direction, subpath_.throughput, partials, depth_);
      if (depth_ == 1 && c_.set.light_samples) v.light_sample = direct_.variance;
      return pass(v, hit, false);
    }
  }

  /// There is no vertex where the sub-path ends.
  bool miss() {
    missed_ = 1;
    return false;
  }

  /// Squared distance from the last vertex; that to the light cancels.
  float distance2(const Point3f& p) const {
    return depth_ == 1 ? 1.0f : length_squared(p - subpath_.from);
  }

  Partials arrive_at(const Arrival& a) {
    if (depth_ == 1) {
      direct_ = start_.direct(a.at);
      record_first_arrival(start_, direct_.density, a.cosine, c_.pdfs, a.transmittance);
      return first_light_partials(start_, direct_.density, a.cosine, c_.set, a.transmittance);
    }
    record_arrival(subpath_, a.d2 / a.transmittance, a.cosine);
    return arrive(subpath_.partials, a.d2 / a.transmittance, a.cosine,
                  c_.set.subpath_connections());
  }

  /// Whether the sub-path goes on behind the vertex.
  bool pass(const Vertex& v, const Hit& hit, bool may_be_passed) {
    c_.sampler.start_dimension(dimension_ + kLensOffset);
    // Where normals are strict no light arrives from between the two horizons of a surface.
    const bool is_dark = (depth_ == 1 && start_.is_before_entry(v.position())) ||
                         (c_.options.strict_normals && v.has_two_sides(v.wo));
    if (!is_dark) visit_(v, hit);
    if (depth_ == c_.max_depth && !may_be_passed) return is_dark && miss();
    c_.sampler.start_dimension(dimension_);
    dimension_ += kLightVertexStride<Vertex>;
    bool straight = false;
    if (!scatter<Transport::importance>(v, c_.set, c_.options, c_.sampler, subpath_, &straight))
      return is_dark && miss();
    if (Vertex::kMedia && straight) return true;
    if (is_dark) return miss();
    return depth_++ < c_.max_depth;
  }

  const LightSubpathContext& c_;
  const LightStart& start_;
  Visit& visit_;
  SubpathOf<Vertex> subpath_;
  StartByLightSample direct_;  ///< at the first vertex
  int depth_ = 1, missed_ = 0;
  uint32_t dimension_ = kLightStartDimensions;
};

/// Traces one sub-path from its start; empty ones have no vertices. `visit(vertex, hit)` sees every
/// vertex, on surfaces where they were hit, and finds the sampler at the random numbers for the
/// lens. Returns the number of vertices. `Vertex` is PathVertex or MediaVertex.
template <class Vertex = PathVertex, class Visit>
int trace_light_subpath(const LightSubpathContext& context, const std::optional<LightStart>& start,
                        Visit&& visit) {
  ++context.counters.light_paths;
  if (context.pdfs) context.pdfs->clear();
  if (!start || context.max_depth < 1) return 0;
  return LightSubpath<Vertex, std::remove_reference_t<Visit>>(context, *start, visit).trace();
}

/// The same for the start that the sampler's first random numbers make.
template <class Vertex = PathVertex, class Visit>
int trace_light_subpath(const LightSubpathContext& context, Visit&& visit) {
  context.sampler.start_dimension(0);
  const auto start = start_light_subpath(context.scene, context.starts, context.sampler);
  return trace_light_subpath<Vertex>(context, start, visit);
}

}  // namespace duet
