// The eye sub-paths of the bidirectional methods, and what they are connected with.
#include "integrators/bidirectional_connect.h"

namespace duet {

namespace {

/// Keeps the random numbers of shadow rays through media apart from others.
constexpr uint64_t kShadowStream = 0x736861646f77ull;

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

}  // namespace

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
  ConnectionContext<Weights> connections() {
    return eye_.connections(weights_, options_.strict_normals);
  }

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
    if (hits()) m_.add(eye_, 0, depth_ + 1, connect_escape(connections(), subpath_, transmittance));
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
      m_.add(
          eye_, 0, depth_ + 1,
          connect_hit(connections(), subpath_, s, d2, Vertex::kMedia ? 0 : depth_, transmittance));
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

bool BidirectionalIntegrator::merges_in(uint64_t pixel) const {
  return set_.partly_merged ? mask_.merges_in(pixel) : set_.merges;
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

template <class Vertex>
Spectrum BidirectionalIntegrator::trace(const Scene& scene, const CameraPath& path,
                                        Sampler& sampler, RenderCounters& counters,
                                        std::span<float> values) const {
  const uint64_t key = hash_combine(key_, path.pixel);
  EyeWorkspace<Vertex>& workspace =
      static_cast<BidirectionalWorkspace<Vertex>&>(*path.workspace).eye;
  Eye<Vertex> eye{scene,
                  LightStarts(scene, guide_.get()),
                  path,
                  sampler,
                  counters,
                  values,
                  ConnectionRoulette(pilot_->roulette_threshold(), ~key),
                  key,
                  key,
                  RandomStream(key + kShadowStream),
                  workspace,
                  merges_in(path.pixel)};
  const size_t subpaths = lights_.vertices().ends.size();
  if (subpaths > 0) eye.light_subpath = sharing_.subpath(path.pixel, subpaths);
  if (options_.method == Method::reuse && options_.weights == ReuseWeights::exact) {
    SubpathPdfs& pdfs = workspace.pdfs;
    pdfs.assign(1, VertexPdfs{1, 0, 1, false});
    WindowWeights weights(windows_, nullptr, &pdfs);
    subpath(weights, &pdfs, eye);
  } else if (options_.method == Method::ptracer || options_.method == Method::ppm) {
    subpath(UnitWeights(), nullptr, eye);
  } else {
    subpath(BalanceWeights(set_, eye.merging), nullptr, eye);
  }
  return eye.sum;
}

std::unique_ptr<PathWorkspace> BidirectionalIntegrator::make_workspace(const Scene& scene) const {
  if (scene.needs_media_vertices()) return std::make_unique<BidirectionalWorkspace<MediaVertex>>();
  return std::make_unique<BidirectionalWorkspace<PathVertex>>();
}

Spectrum BidirectionalIntegrator::radiance(const Scene& scene, const CameraPath& path,
                                           Sampler& sampler, RenderCounters& counters,
                                           std::span<float> values) const {
  if (max_depth_ == 0) return {};
  return scene.needs_media_vertices() ? trace<MediaVertex>(scene, path, sampler, counters, values)
                                      : trace<PathVertex>(scene, path, sampler, counters, values);
}

}  // namespace duet
