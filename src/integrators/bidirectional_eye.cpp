// The eye walks of the bidirectional methods, and what they are joined with.
#include "integrators/bidirectional.h"
#include "integrators/next_event.h"

namespace duet {

namespace {

/// Photons in the cells around a vertex from which on only some of them are merged: all light on
/// one spot must not make the time grow with the square of the photons.
constexpr size_t kMostMergedPhotons = 4096;
/// Keeps the random numbers of shadow rays through media apart from others.
constexpr uint64_t kShadowStream = 0x736861646f77ull;

}  // namespace

/// An eye walk under way.
template <class Vertex>
struct BidirectionalIntegrator::Eye {
  const Scene& scene;
  const CameraPath& start;
  Sampler& sampler;
  RenderCounters& counters;
  std::span<float> values;
  JoinRoulette roulette;
  uint64_t random;       ///< key of numbers that no dimension of the sampler is set aside for
  RandomStream shadows;  ///< for shadow rays through media
  std::vector<uint32_t>& photons;  ///< those near the vertex under way
  bool merging;                    ///< in this pixel, if the method merges
  Spectrum sum{};
  size_t light_walk = 0;  ///< the one that belongs to the pixel
  /// Its vertices, once the walk has a vertex to join them with.
  const std::vector<Vertex>* light_vertices = nullptr;
  float photon_share = 1;             ///< for how many photons each of them stands
  VertexGrid::Neighborhood around{};  ///< where photons near the vertex under way are looked for

  float draw() {
    random = mix64(random + 0x9e3779b97f4a7c15ull);
    return to_unit_float(uint32_t(random >> 32));
  }
};

namespace {

/// An eye walk before its ray is known.
template <class Vertex>
WalkOf<Vertex> new_eye_walk(const Scene& scene, [[maybe_unused]] uint64_t seed) {
  if constexpr (Vertex::kMedia)
    return MediaWalk(scene, Walk(), scene.camera_medium, seed);
  else
    return Walk();
}

bool may_be_passed(const Scene& scene, const Surface& s) {
  return scene.materials[s.shape->material]->passes_straight();
}

void add_to_layer(std::span<float> values, size_t layer, const Spectrum& v) {
  values[layer] += v.r, values[layer + 1] += v.g, values[layer + 2] += v.b;
}

}  // namespace

template <class Vertex>
void BidirectionalIntegrator::add(Eye<Vertex>& eye, int s, int t, const Join& join) const {
  eye.sum += join.value * join.weight;
  if (const size_t layer = layers_.join(s, t))
    add_to_layer(eye.values, layer, raw_techniques_ ? join.value : join.value * join.weight);
}

template <class Vertex, class Weights>
void BidirectionalIntegrator::walk(const Weights& weights, Trail* trail, Eye<Vertex>& eye) const {
  const Scene& scene = eye.scene;
  const Ray& camera_ray = eye.start.ray;
  float& alpha = eye.values[3];
  const WalkOptions options{options_.rr_depth, options_.strict_normals};
  WalkOf<Vertex> walk = new_eye_walk<Vertex>(scene, ~eye.random);
  walk.ray = options_.hide_emitters ? behind_emitters(scene, camera_ray, eye.counters) : camera_ray;
  walk.from = walk.ray.origin;
  walk.throughput = Spectrum(1);
  walk.trail = trail;
  int depth = 1;
  bool straight = false;  // the last surface was passed as if it had not been there
  uint32_t dimension = kFirstVertexDimension;
  const auto arrive_at = [&](const Point3f& p, float d2, float cosine, float transmittance) {
    const Partials partials =
        depth == 1 ? first_eye_partials(scene, camera_ray, p, d2, cosine, set_, walk, transmittance)
                   : arrive(walk.partials, d2 / transmittance, cosine, set_.walk_connections());
    record_arrival(walk, d2 / transmittance, cosine);
    return partials;
  };
  /// Joins a vertex and scatters; whether the walk goes on.
  const auto pass = [&](const Vertex& v) {
    eye.sampler.start_dimension(dimension);
    if (v.is_smooth()) {
      if (!Vertex::kMedia || depth < max_depth_) join(weights, v, samples_light(v, walk), eye);
    } else {
      eye.counters.connections.failed_specular += uint64_t(candidates(v, eye));
    }
    if constexpr (!Vertex::kMedia)
      if (is_thesis_ && depth == windows_.eye) {
        alpha = 1;
        thesis_tail(v, walk, eye);
        return false;
      }
    straight = false;
    eye.sampler.start_dimension(dimension + kScatteringDimension);
    dimension += kDimensionsPerVertex;
    const bool goes_on =
        (Vertex::kMedia || options_.method != Method::ptracer) &&
        scatter<Transport::radiance>(v, set_, options, eye.sampler, walk, &straight);
    if (!straight) alpha = 1;
    if (Vertex::kMedia && straight) return goes_on;
    ++depth;
    return goes_on && (options_.method != Method::ppm || walk.unmerged) &&
           (!Vertex::kMedia || (depth <= max_depth_ && options_.method != Method::ptracer));
  };
  for (;;) {
    if (trail && depth == windows_.eye + 1 && !(Vertex::kMedia && straight) &&
        !enter_tail(walk, eye))
      return;
    // Where merging or light tracing does the rest, only what is seen directly is left to be hit.
    const bool hits = set_.light_samples || (set_.merges ? walk.unmerged : depth == 1);
    Hit hit;
    ++eye.counters.closest_rays;
    const bool found = scene.accel->closest_hit(walk.ray, hit);
    float transmittance = 1;
    if constexpr (Vertex::kMedia) {
      if (walk.medium) {
        Ray segment = walk.ray;
        if (found) segment.tmax = hit.t;
        eye.sampler.start_dimension(dimension + kDistanceDimension);
        const float t = walk.cross(segment, eye.sampler.next_1d(), eye.counters);
        if (t < INFINITY) {
          alpha = 1;
          const Point3f p = walk.ray.origin + walk.ray.direction * t;
          const float d2 = length_squared(p - walk.from);
          const float extinction = walk.medium->nominal_extinction(p);
          if (depth == max_depth_ || !(d2 > 0 && extinction > 0)) return;
          ++eye.counters.path_vertices;
          const Partials partials = arrive_at(p, d2, extinction, walk.counted_transmittance());
          const Vertex v(*walk.medium, extinction, p, -walk.ray.direction, walk.throughput,
                         partials, depth);
          if (!pass(v)) return;
          continue;
        }
      }
      transmittance = walk.counted_transmittance();
    }
    // Lights that are not to be seen are surfaces like others behind those that light passes, and
    // the sky stays hidden there.
    const bool hidden = options_.hide_emitters && alpha == 0;
    if (!found) {
      if (!scene.environment || hidden) return;
      if (hits) add(eye, 0, depth + 1, join_escape(scene, weights, walk, transmittance));
      alpha = 1;
      return;
    }
    ++eye.counters.path_vertices;
    const Surface s = scene.surface(walk.ray, hit);
    if (eye.merging) eye.around = grid_.locate(s.position);
    float d2 = hit.t * hit.t;
    if constexpr (Vertex::kMedia) d2 = length_squared(s.position - walk.from);
    const float cosine = std::abs(dot(s.ng, walk.ray.direction));
    if (hits && s.shape->light != kNone && !(Vertex::kMedia && hidden))
      add(eye, 0, depth + 1, join_hit(scene, weights, walk, s, d2, transmittance));
    if ((depth == max_depth_ && !(Vertex::kMedia && may_be_passed(scene, s))) || !(cosine > 0)) {
      alpha = 1;
      return;
    }
    const Partials partials = arrive_at(s.position, d2, cosine, transmittance);
    if constexpr (Vertex::kMedia) {
      const Vertex v(scene, s, -walk.ray.direction, walk.throughput, partials, depth, walk.medium);
      if (!pass(v)) return;
    } else {
      const Vertex v(scene, s, -walk.ray.direction, walk.throughput, partials, depth);
      if (!pass(v)) return;
    }
  }
}

template <class Vertex, class Weights>
void BidirectionalIntegrator::join(const Weights& weights, const Vertex& v, bool light_sample,
                                   Eye<Vertex>& eye) const {
  if (light_sample && eye.scene.picker.size() > 0)
    add(eye, 1, v.depth + 1,
        join_light(eye.scene, weights, v, options_.strict_normals, eye.sampler, eye.roulette,
                   eye.counters, &eye.shadows));
  if (eye.merging && v.merges()) find_photons(v, eye);
  if (set_.connections) {
    if (options_.connections < 0)
      connect(weights, v, eye);
    else
      connect_to_cache(weights, v, eye);
  }
  if constexpr (!std::is_same_v<Weights, WindowWeights>)
    if (eye.merging && v.merges()) merge(weights, v, eye);
}

template <class Vertex>
bool BidirectionalIntegrator::samples_light(const Vertex& v, const Walk& walk) const {
  return set_.light_samples || (set_.merges && walk.unmerged && v.bsdf.has_nearly_specular());
}

template <class Vertex>
int BidirectionalIntegrator::candidates(const Vertex& v, const Eye<Vertex>& eye) const {
  const LightVertices& light = lights_.vertices();
  if (!set_.connections || options_.connections >= 0 || light.ends.empty()) return 0;
  if (options_.method == Method::reuse && v.depth > windows_.eye) return 0;
  return std::clamp(max_depth_ - v.depth - 1, 0, int(light.lengths[eye.light_walk]));
}

template <class Vertex, class Weights>
void BidirectionalIntegrator::connect(const Weights& weights, const Vertex& v,
                                      Eye<Vertex>& eye) const {
  const int most = candidates(v, eye);
  if (most == 0) return;
  if (!eye.light_vertices) {
    thread_local std::vector<Vertex> unpacked;
    unpacked.clear();
    for (const LightVertex& l : lights_.vertices().walk(eye.light_walk))
      unpacked.emplace_back(Unpacked<Vertex>{l, eye.scene});
    eye.light_vertices = &unpacked;
  }
  int tried = 0;
  for (const Vertex& l : *eye.light_vertices) {
    if (l.depth > most) break;
    ++tried;
    add(eye, l.depth + 1, v.depth + 1,
        join_ends(eye.scene, weights, l, v, options_.strict_normals, eye.roulette, eye.counters,
                  &eye.shadows));
  }
  eye.counters.connections.failed_specular += uint64_t(most - tried);
}

template <class Vertex, class Weights>
void BidirectionalIntegrator::connect_to_cache(const Weights& weights, const Vertex& v,
                                               Eye<Vertex>& eye) const {
  const std::vector<LightVertex>& cache = lights_.vertices().vertices;
  if (cache.empty()) return;
  // Every vertex of all walks is drawn with the same probability.
  const float scale =
      float(double(cache.size()) / (double(set_.light_paths) * options_.connections));
  for (int i = 0; i < options_.connections; ++i) {
    const LightVertex& drawn =
        cache[std::min(size_t(double(eye.draw()) * double(cache.size())), cache.size() - 1)];
    if (int(drawn.depth) + v.depth + 1 > max_depth_) continue;
    Join found = join_ends(eye.scene, weights, drawn.unpack<Vertex>(eye.scene), v,
                           options_.strict_normals, eye.roulette, eye.counters, &eye.shadows);
    found.value *= scale;
    add(eye, int(drawn.depth) + 1, v.depth + 1, found);
  }
}

template <class Vertex>
void BidirectionalIntegrator::find_photons(const Vertex& v, Eye<Vertex>& eye) const {
  const std::vector<LightVertex>& photons = lights_.vertices().vertices;
  ++eye.counters.merge_queries;
  eye.photons.clear();
  eye.photon_share = 1;
  grid_.sample(
      v.position(), eye.around, kMostMergedPhotons, [&] { return eye.draw(); },
      [&](uint32_t index, float, size_t share) {
        __builtin_prefetch(&photons[index]);
        eye.photons.push_back(index);
        eye.photon_share = float(share);
      });
}

template <class Vertex, class Weights>
void BidirectionalIntegrator::merge(const Weights& weights, const Vertex& v,
                                    Eye<Vertex>& eye) const {
  const float kernel = eye.photon_share / (set_.merge_area * set_.light_paths);
  for (const uint32_t index : eye.photons) {
    const LightVertex& photon = lights_.vertices().vertices[index];
    if (int(photon.depth) + v.depth > max_depth_) continue;
    const Join found = join_merge(weights, photon, v, kernel, options_.strict_normals);
    if (found.value.is_black()) continue;
    ++eye.counters.merges;
    eye.sum += found.value * found.weight;
    if (const size_t layer = layers_.merge(int(photon.depth) + 1, v.depth + 1))
      add_to_layer(eye.values, layer, raw_techniques_ ? found.value : found.value * found.weight);
  }
}

bool BidirectionalIntegrator::merges_in(uint64_t pixel) const {
  if (!set_.partly_merged) return set_.merges;
  const uint64_t width = uint64_t(mask_.film.x);
  return mask_.merges({float(pixel % width) + 0.5f, float(pixel / width) + 0.5f});
}

template <class Vertex>
bool BidirectionalIntegrator::enter_tail(Walk& walk, Eye<Vertex>& eye) const {
  ++eye.counters.eye_subpaths_at_limit;
  const float q = float(options_.continue_probability);
  if (q < 1) {
    if (!(eye.draw() < q)) return false;
    walk.throughput *= 1 / q;
  }
  ++eye.counters.reused_subpaths;
  return true;
}

void BidirectionalIntegrator::thesis_tail(const PathVertex& limit, Walk& walk,
                                          Eye<PathVertex>& eye) const {
  ++eye.counters.eye_subpaths_at_limit;
  const LightVertices& light = lights_.vertices();
  const bool light_end_joins = !light.ends.empty() && !light.walk(eye.light_walk).empty() &&
                               int(light.walk(eye.light_walk).back().depth) == windows_.light;
  const bool specular = !limit.bsdf.has_smooth();
  if (!specular && (options_.weights == ReuseWeights::thesis_a || light_end_joins)) return;
  ++eye.counters.reused_subpaths;
  const WalkOptions options{options_.rr_depth, options_.strict_normals};
  const Scene& scene = eye.scene;
  const PathVertex* v = &limit;
  std::optional<PathVertex> reached;
  for (int depth = limit.depth + 1; depth <= max_depth_; ++depth) {
    eye.sampler.start_dimension(kFirstVertexDimension + kDimensionsPerVertex * uint32_t(depth - 2) +
                                kScatteringDimension);
    if (!scatter<Transport::radiance>(*v, set_, options, eye.sampler, walk)) return;
    Hit hit;
    ++eye.counters.closest_rays;
    if (!scene.accel->closest_hit(walk.ray, hit)) {
      if (scene.environment) add(eye, 0, depth + 1, join_escape(scene, PathWeights(), walk));
      return;
    }
    ++eye.counters.path_vertices;
    const Surface s = scene.surface(walk.ray, hit);
    if (s.shape->light != kNone)
      add(eye, 0, depth + 1, join_hit(scene, PathWeights(), walk, s, hit.t * hit.t));
    if (depth == max_depth_) return;
    reached.emplace(scene, s, -walk.ray.direction, walk.throughput, Partials{}, depth);
    v = &*reached;
    if (!v->bsdf.has_smooth() || scene.picker.size() == 0) continue;
    eye.sampler.start_dimension(kFirstVertexDimension + kDimensionsPerVertex * uint32_t(depth - 1));
    add(eye, 1, depth + 1,
        join_light(scene, PathWeights(), *v, options_.strict_normals, eye.sampler, eye.roulette,
                   eye.counters));
  }
}

template <class Vertex>
Spectrum BidirectionalIntegrator::trace(const Scene& scene, const CameraPath& path,
                                        Sampler& sampler, RenderCounters& counters,
                                        std::span<float> values) const {
  const uint64_t key = hash_combine(key_, path.pixel);
  thread_local std::vector<uint32_t> photons;
  Eye<Vertex> eye{scene,   path,
                  sampler, counters,
                  values,  JoinRoulette(pilot_->roulette_threshold(), ~key),
                  key,     RandomStream(key + kShadowStream),
                  photons, merges_in(path.pixel)};
  const size_t walks = lights_.vertices().ends.size();
  if (walks > 0) eye.light_walk = sharing_.walk(path.pixel, walks);
  if (options_.method == Method::reuse && options_.weights == ReuseWeights::exact) {
    thread_local Trail trail;
    trail.assign(1, TrailVertex{1, 0, 1, false});
    WindowWeights weights(windows_, nullptr, &trail);
    if (walks > 0) weights.set_light(lights_.trail(eye.light_walk));
    walk(weights, &trail, eye);
  } else if (options_.method == Method::ptracer || options_.method == Method::ppm) {
    walk(UnitWeights(), nullptr, eye);
  } else {
    walk(BalanceWeights(set_, eye.merging), nullptr, eye);
  }
  return eye.sum;
}

Spectrum BidirectionalIntegrator::radiance(const Scene& scene, const CameraPath& path,
                                           Sampler& sampler, RenderCounters& counters,
                                           std::span<float> values) const {
  if (max_depth_ == 0) return {};
  return scene.media.empty() ? trace<PathVertex>(scene, path, sampler, counters, values)
                             : trace<MediaVertex>(scene, path, sampler, counters, values);
}

}  // namespace duet
