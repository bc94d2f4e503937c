// The eye sub-paths of the bidirectional methods, and what they are connected with.
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

/// An eye sub-path under way.
template <class Vertex>
struct BidirectionalIntegrator::Eye {
  const Scene& scene;
  const CameraPath& start;
  Sampler& sampler;
  RenderCounters& counters;
  std::span<float> values;
  ConnectionRoulette roulette;
  uint64_t random;       ///< key of numbers that no dimension of the sampler is set aside for
  RandomStream shadows;  ///< for shadow rays through media
  std::vector<uint32_t>& photons;  ///< those near the vertex under way
  bool merging;                    ///< in this pixel, if the method merges
  Spectrum sum{};
  size_t light_subpath = 0;  ///< the one that belongs to the pixel
  /// Its vertices, once the sub-path has a vertex to connect them with.
  const std::vector<Vertex>* light_vertices = nullptr;
  float photon_share = 1;             ///< for how many photons each of them stands
  VertexGrid::Neighborhood around{};  ///< where photons near the vertex under way are looked for

  /// What the vertices of the sub-path are connected with.
  template <class Weights>
  ConnectionContext<Weights> connections(const Weights& weights, bool strict_normals) {
    return {scene, weights, roulette, counters, strict_normals, &shadows};
  }

  float draw() {
    random = mix64(random + 0x9e3779b97f4a7c15ull);
    return to_unit_float(uint32_t(random >> 32));
  }
};

namespace {

/// An eye sub-path before its ray is known.
template <class Vertex>
SubpathOf<Vertex> new_eye_subpath(const Scene& scene, [[maybe_unused]] uint64_t seed) {
  if constexpr (Vertex::kMedia)
    return MediaSubpath(scene, Subpath(), scene.camera_medium, seed);
  else
    return Subpath();
}

bool may_be_passed(const Scene& scene, const Surface& s) {
  return scene.materials[s.shape->material]->passes_straight();
}

void add_to_layer(std::span<float> values, size_t layer, const Spectrum& v) {
  values[layer] += v.r, values[layer + 1] += v.g, values[layer + 2] += v.b;
}

}  // namespace

template <class Vertex>
void BidirectionalIntegrator::add(Eye<Vertex>& eye, int s, int t,
                                  const Connection& connection) const {
  eye.sum += connection.value * connection.weight;
  if (const size_t layer = layers_.connection(s, t))
    add_to_layer(eye.values, layer,
                 raw_techniques_ ? connection.value : connection.value * connection.weight);
}

/// The sub-path itself: from vertex to vertex, each of which is connected with what there is.
template <class Vertex, class Weights>
class BidirectionalIntegrator::EyeSubpath {
 public:
  /// `pdfs`, if not null, is filled.
  EyeSubpath(const BidirectionalIntegrator& method, const Weights& weights, SubpathPdfs* pdfs,
             Eye<Vertex>& eye)
      : m_(method),
        weights_(weights),
        pdfs_(pdfs),
        eye_(eye),
        scene_(eye.scene),
        options_{method.options_.rr_depth, method.options_.strict_normals},
        subpath_(new_eye_subpath<Vertex>(eye.scene, ~eye.random)),
        alpha_(eye.values[3]) {
    const Ray& ray = eye.start.ray;
    subpath_.ray = hides_emitters() ? behind_emitters(scene_, ray, eye.counters) : ray;
    subpath_.from = subpath_.ray.origin;
    subpath_.throughput = Spectrum(1);
    subpath_.pdfs = pdfs;
  }

  void trace() {
    for (;;) {
      if (pdfs_ && depth_ == m_.windows_.eye + 1 && !(Vertex::kMedia && straight_) &&
          !m_.enter_tail(subpath_, eye_))
        return;
      Hit hit;
      ++eye_.counters.closest_rays;
      const bool found = scene_.accel->closest_hit(subpath_.ray, hit);
      float transmittance = 1;
      if constexpr (Vertex::kMedia) {
        if (const float t = subpath_.cross(found ? hit.t : INFINITY, eye_.sampler,
                                           dimension_ + kDistanceDimension, eye_.counters);
            t < INFINITY) {
          if (!scatter_between(t)) return;
          continue;
        }
        transmittance = subpath_.counted_transmittance();
      }
      if (!found) return escape(transmittance);
      if (!meet_surface(hit, transmittance)) return;
    }
  }

 private:
  bool hides_emitters() const { return m_.options_.hide_emitters; }

  /// Whether light at the end of the sub-path counts. Where merging or light tracing does the rest,
  /// only what is seen directly is left to be hit.
  bool hits() const {
    return m_.set_.light_samples || (m_.set_.merges ? subpath_.unmerged : depth_ == 1);
  }

  /// Lights that are not to be seen are surfaces like others behind those that light passes, and
  /// the sky stays hidden there.
  bool hides_lights() const { return hides_emitters() && alpha_ == 0; }

  /// In a medium; whether the sub-path goes on.
  bool scatter_between(float t) {
    alpha_ = 1;
    const Point3f p = subpath_.ray.origin + subpath_.ray.direction * t;
    const float d2 = length_squared(p - subpath_.from);
    const float extinction = subpath_.medium->nominal_extinction(p);
    if (depth_ == m_.max_depth_ || !(d2 > 0 && extinction > 0)) return false;
    ++eye_.counters.path_vertices;
    const Partials partials = arrive_at({p, d2, extinction, subpath_.counted_transmittance()});
    const Vertex v({*subpath_.medium, extinction, p}, -subpath_.ray.direction,
                   {subpath_.throughput, partials, depth_});
    return pass(v);
  }

  void escape(float transmittance) {
    if (!scene_.environment || hides_lights()) return;
    if (hits())
      m_.add(eye_, 0, depth_ + 1, connect_escape(scene_, weights_, subpath_, transmittance));
    alpha_ = 1;
  }

  /// Whether the sub-path goes on.
  bool meet_surface(const Hit& hit, float transmittance) {
    ++eye_.counters.path_vertices;
    const Surface s = scene_.surface(subpath_.ray, hit);
    if (eye_.merging) eye_.around = m_.grid_.locate(s.position);
    float d2 = hit.t * hit.t;
    if constexpr (Vertex::kMedia) d2 = length_squared(s.position - subpath_.from);
    const float cosine = std::abs(dot(s.ng, subpath_.ray.direction));
    if (hits() && s.shape->light != kNone && !(Vertex::kMedia && hides_lights()))
      m_.add(eye_, 0, depth_ + 1, connect_hit(scene_, weights_, subpath_, s, d2, transmittance));
    if ((depth_ == m_.max_depth_ && !(Vertex::kMedia && may_be_passed(scene_, s))) ||
        !(cosine > 0)) {
      alpha_ = 1;
      return false;
    }
    const Partials partials = arrive_at({s.position, d2, cosine, transmittance});
    if constexpr (Vertex::kMedia) {
      const Vertex v(scene_, s, -subpath_.ray.direction, {subpath_.throughput, partials, depth_},
                     subpath_.medium);
      return pass(v);
    } else {
      const Vertex v(scene_, s, -subpath_.ray.direction, subpath_.throughput, partials, depth_);
      return pass(v);
    }
  }

  Partials arrive_at(const Arrival& a) {
    const Partials partials = depth_ == 1
                                  ? first_eye_partials(scene_, eye_.start.ray, a, m_.set_, subpath_)
                                  : arrive(subpath_.partials, a.d2 / a.transmittance, a.cosine,
                                           m_.set_.subpath_connections());
    record_arrival(subpath_, a.d2 / a.transmittance, a.cosine);
    return partials;
  }

  /// Connects a vertex and scatters; whether the sub-path goes on.
  bool pass(const Vertex& v) {
    eye_.sampler.start_dimension(dimension_);
    if (v.is_smooth()) {
      if (!Vertex::kMedia || depth_ < m_.max_depth_)
        m_.connect(weights_, v, m_.samples_light(v, subpath_), eye_);
    } else {
      eye_.counters.connections.failed_specular += uint64_t(m_.candidates(v, eye_));
    }
    if constexpr (!Vertex::kMedia)
      if (m_.is_thesis_ && depth_ == m_.windows_.eye) {
        alpha_ = 1;
        m_.thesis_tail(v, subpath_, eye_);
        return false;
      }
    straight_ = false;
    eye_.sampler.start_dimension(dimension_ + kScatteringDimension);
    dimension_ += kDimensionsPerVertex;
    const Method method = m_.options_.method;
    const bool goes_on =
        (Vertex::kMedia || method != Method::ptracer) &&
        scatter<Transport::radiance>(v, m_.set_, options_, eye_.sampler, subpath_, &straight_);
    if (!straight_) alpha_ = 1;
    if (Vertex::kMedia && straight_) return goes_on;
    ++depth_;
    return goes_on && (method != Method::ppm || subpath_.unmerged) &&
           (!Vertex::kMedia || (depth_ <= m_.max_depth_ && method != Method::ptracer));
  }

  const BidirectionalIntegrator& m_;
  const Weights& weights_;
  SubpathPdfs* const pdfs_;
  Eye<Vertex>& eye_;
  const Scene& scene_;
  const SubpathOptions options_;
  SubpathOf<Vertex> subpath_;
  float& alpha_;
  int depth_ = 1;
  bool straight_ = false;  ///< the last surface was passed as if it had not been there
  uint32_t dimension_ = kFirstVertexDimension;
};

template <class Vertex, class Weights>
void BidirectionalIntegrator::subpath(const Weights& weights, SubpathPdfs* pdfs,
                                      Eye<Vertex>& eye) const {
  EyeSubpath<Vertex, Weights>(*this, weights, pdfs, eye).trace();
}

template <class Vertex, class Weights>
void BidirectionalIntegrator::connect(const Weights& weights, const Vertex& v, bool light_sample,
                                      Eye<Vertex>& eye) const {
  if (light_sample && eye.scene.picker.size() > 0)
    add(eye, 1, v.depth + 1,
        connect_light(eye.connections(weights, options_.strict_normals), v, eye.sampler));
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
bool BidirectionalIntegrator::samples_light(const Vertex& v, const Subpath& subpath) const {
  return set_.light_samples || (set_.merges && subpath.unmerged && v.bsdf.has_nearly_specular());
}

template <class Vertex>
int BidirectionalIntegrator::candidates(const Vertex& v, const Eye<Vertex>& eye) const {
  const LightVertices& light = lights_.vertices();
  if (!set_.connections || options_.connections >= 0 || light.ends.empty()) return 0;
  if (options_.method == Method::reuse && v.depth > windows_.eye) return 0;
  return std::clamp(max_depth_ - v.depth - 1, 0, int(light.lengths[eye.light_subpath]));
}

template <class Vertex, class Weights>
void BidirectionalIntegrator::connect(const Weights& weights, const Vertex& v,
                                      Eye<Vertex>& eye) const {
  const int most = candidates(v, eye);
  if (most == 0) return;
  if (!eye.light_vertices) {
    thread_local std::vector<Vertex> unpacked;
    unpacked.clear();
    for (const LightVertex& l : lights_.vertices().subpath(eye.light_subpath))
      unpacked.emplace_back(Unpacked<Vertex>{l, eye.scene});
    eye.light_vertices = &unpacked;
  }
  Weights own = weights;
  const ConnectionContext<Weights> connections = eye.connections(own, options_.strict_normals);
  int tried = 0;
  for (const Vertex& l : *eye.light_vertices) {
    if (l.depth > most) break;
    if constexpr (Vertex::kMedia && std::is_same_v<Weights, WindowWeights>)
      own.set_light(lights_.pdfs(eye.light_subpath),
                    &lights_.end_pdfs(eye.light_subpath)[size_t(tried)]);
    ++tried;
    add(eye, l.depth + 1, v.depth + 1, connect_ends(connections, l, v));
  }
  eye.counters.connections.failed_specular += uint64_t(most - tried);
}

template <class Vertex, class Weights>
void BidirectionalIntegrator::connect_to_cache(const Weights& weights, const Vertex& v,
                                               Eye<Vertex>& eye) const {
  const std::vector<LightVertex>& cache = lights_.vertices().vertices;
  if (cache.empty()) return;
  // Every vertex of all sub-paths is drawn with the same probability.
  const float scale =
      float(double(cache.size()) / (double(set_.light_paths) * options_.connections));
  const ConnectionContext<Weights> connections = eye.connections(weights, options_.strict_normals);
  for (int i = 0; i < options_.connections; ++i) {
    const LightVertex& drawn =
        cache[std::min(size_t(double(eye.draw()) * double(cache.size())), cache.size() - 1)];
    if (int(drawn.depth) + v.depth + 1 > max_depth_) continue;
    Connection found = connect_ends(connections, drawn.unpack<Vertex>(eye.scene), v);
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
    const Connection found = connect_merge(weights, photon, v, kernel, options_.strict_normals);
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
bool BidirectionalIntegrator::enter_tail(Subpath& subpath, Eye<Vertex>& eye) const {
  ++eye.counters.eye_subpaths_at_limit;
  const float q = float(options_.continue_probability);
  if (q < 1) {
    if (!(eye.draw() < q)) return false;
    subpath.throughput *= 1 / q;
  }
  ++eye.counters.reused_subpaths;
  return true;
}

void BidirectionalIntegrator::thesis_tail(const PathVertex& limit, Subpath& subpath,
                                          Eye<PathVertex>& eye) const {
  ++eye.counters.eye_subpaths_at_limit;
  const LightVertices& light = lights_.vertices();
  const bool light_end_connections =
      !light.ends.empty() && !light.subpath(eye.light_subpath).empty() &&
      int(light.subpath(eye.light_subpath).back().depth) == windows_.light;
  const bool specular = !limit.bsdf.has_smooth();
  if (!specular && (options_.weights == ReuseWeights::thesis_a || light_end_connections)) return;
  ++eye.counters.reused_subpaths;
  const SubpathOptions options{options_.rr_depth, options_.strict_normals};
  const Scene& scene = eye.scene;
  const PathVertex* v = &limit;
  std::optional<PathVertex> reached;
  for (int depth = limit.depth + 1; depth <= max_depth_; ++depth) {
    eye.sampler.start_dimension(kFirstVertexDimension + kDimensionsPerVertex * uint32_t(depth - 2) +
                                kScatteringDimension);
    if (!scatter<Transport::radiance>(*v, set_, options, eye.sampler, subpath)) return;
    Hit hit;
    ++eye.counters.closest_rays;
    if (!scene.accel->closest_hit(subpath.ray, hit)) {
      if (scene.environment) add(eye, 0, depth + 1, connect_escape(scene, PathWeights(), subpath));
      return;
    }
    ++eye.counters.path_vertices;
    const Surface s = scene.surface(subpath.ray, hit);
    if (s.shape->light != kNone)
      add(eye, 0, depth + 1, connect_hit(scene, PathWeights(), subpath, s, hit.t * hit.t));
    if (depth == max_depth_) return;
    reached.emplace(scene, s, -subpath.ray.direction, subpath.throughput, Partials{}, depth);
    v = &*reached;
    if (!v->bsdf.has_smooth() || scene.picker.size() == 0) continue;
    eye.sampler.start_dimension(kFirstVertexDimension + kDimensionsPerVertex * uint32_t(depth - 1));
    add(eye, 1, depth + 1,
        connect_light(eye.connections(PathWeights(), options_.strict_normals), *v, eye.sampler));
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
                  values,  ConnectionRoulette(pilot_->roulette_threshold(), ~key),
                  key,     RandomStream(key + kShadowStream),
                  photons, merges_in(path.pixel)};
  const size_t subpaths = lights_.vertices().ends.size();
  if (subpaths > 0) eye.light_subpath = sharing_.subpath(path.pixel, subpaths);
  if (options_.method == Method::reuse && options_.weights == ReuseWeights::exact) {
    thread_local SubpathPdfs pdfs;
    pdfs.assign(1, VertexPdfs{1, 0, 1, false});
    WindowWeights weights(windows_, nullptr, &pdfs);
    if (subpaths > 0) weights.set_light(lights_.pdfs(eye.light_subpath));
    subpath(weights, &pdfs, eye);
  } else if (options_.method == Method::ptracer || options_.method == Method::ppm) {
    subpath(UnitWeights(), nullptr, eye);
  } else {
    subpath(BalanceWeights(set_, eye.merging), nullptr, eye);
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
