#include "integrators/pilot_eye_subpath.h"

#include <algorithm>
#include <cmath>

#include "integrators/camera_integrator.h"
#include "integrators/merge_blur.h"
#include "transport/connection_vertex.h"

namespace duet {

namespace {

constexpr uint64_t kEdgeSeed = 0x65646765ull, kGapSeed = 0x676170ull, kWayStream = 0x776179ull,
                   kPilotShadowStream = 0x7368646full;
/// Keeps the gaps that the vertices of a sub-path look for apart.
constexpr size_t kMostVerticesOfSubpath = FamilyWeights::kMostVertices / 2;

template <class Vertex>
SubpathOf<Vertex> new_pilot_subpath(const Scene& scene, [[maybe_unused]] uint64_t seed) {
  if constexpr (Vertex::kMedia)
    return MediaSubpath(scene, Subpath(), scene.camera_medium, seed);
  else
    return Subpath();
}

template <class Vertex>
class PilotEyeSubpath {
 public:
  PilotEyeSubpath(const PilotSetup& pilot, size_t index, PricingRecord& out, double& seen)
      : pilot_(pilot),
        scene_(pilot.scene),
        index_(index),
        key_(hash_combine(pilot.eye_seed, index)),
        cell_(uint16_t(index / 2)),
        out_(out),
        seen_(seen),
        sampler_(SampleSequence::independent, pilot.eye_seed, 0, index),
        pdfs_{{1, 0, 1, false}},
        subpath_(new_pilot_subpath<Vertex>(scene_, key_ ^ kWayStream)),
        weights_(pilot.set),
        roulette_(pilot.threshold, key_),
        shadows_(key_ ^ kPilotShadowStream),
        sees_lights_(!pilot.plan.hide_emitters) {}

  void trace() {
    start();
    for (;;) {
      weights_.set_eye(pdfs_);
      Hit hit;
      ++counters().closest_rays;
      out_.first_counters.closest_rays += first_;
      const bool found = scene_.accel->closest_hit(subpath_.ray, hit);
      float transmittance = 1;
      if constexpr (Vertex::kMedia) {
        if (float t = subpath_.cross(found ? hit.t : INFINITY, sampler_,
                                     dimension_ + kDistanceDimension, counters());
            t < INFINITY) {
          if (!scatter_between(t)) return;
          continue;
        }
        transmittance = subpath_.counted_transmittance();
      }
      if (!found) {
        if (scene_.environment && sees_lights_)
          add_found(connect_escape(found_light(), subpath_, transmittance), transmittance);
        return;
      }
      if (!meet_surface(hit, transmittance)) return;
    }
  }

 private:
  RenderCounters& counters() { return out_.eye_counters; }

  void start() {
    sampler_.start_sample(0);
    const Point2f u = sampler_.next_2d();
    const Point2f corner = pixel(), film{corner.x + u.x, corner.y + u.y};
    sampler_.start_dimension(kLensDimension);
    const Point2f lens = scene_.camera->has_lens() ? sampler_.next_2d() : Point2f{};
    camera_ray_ = scene_.camera->sample_ray(film, lens);
    ++counters().camera_paths;
    subpath_.ray =
        pilot_.plan.hide_emitters ? behind_emitters(scene_, camera_ray_, counters()) : camera_ray_;
    subpath_.from = subpath_.ray.origin;
    subpath_.throughput = Spectrum(1);
    subpath_.pdfs = &pdfs_;
  }

  /// Where the sub-path's pixel lies: one in each cell of a grid, the same for two sub-paths in
  /// succession.
  Point2f pixel() const {
    const size_t side = size_t(pilot_.plan.pixels_per_side);
    const uint64_t random = mix64(hash_combine(pilot_.eye_seed, cell_));
    const auto place = [&](size_t at, uint64_t bits, int size) {
      const double x = (double(at) + double(to_unit_float(uint32_t(bits)))) / double(side) * size;
      return std::min(float(std::floor(x)), float(size - 1));
    };
    return {place(cell_ % side, random, pilot_.plan.film.x),
            place(cell_ / side, random >> 32, pilot_.plan.film.y)};
  }

  /// In a medium; whether the sub-path goes on.
  bool scatter_between(float t) {
    sees_lights_ = true;
    const Point3f p = subpath_.ray.origin + subpath_.ray.direction * t;
    const float d2 = length_squared(p - subpath_.from);
    const float extinction = subpath_.medium->nominal_extinction(p);
    if (depth_ == pilot_.max_depth || !(d2 > 0 && extinction > 0)) return false;
    ++counters().path_vertices;
    arrive_at({p, d2, extinction, subpath_.counted_transmittance()});
    return leave_vertex(Vertex({*subpath_.medium, extinction, p}, -subpath_.ray.direction,
                               {subpath_.throughput, Partials{}, depth_}));
  }

  bool meet_surface(const Hit& hit, float transmittance) {
    ++counters().path_vertices;
    const Surface s = scene_.surface(subpath_.ray, hit);
    // The way since the last vertex may have led through surfaces that light passes straight.
    const float d2 = Vertex::kMedia ? length_squared(s.position - subpath_.from) : hit.t * hit.t;
    const float cosine = std::abs(dot(s.ng, subpath_.ray.direction));
    if (s.shape->light != kNone && (!Vertex::kMedia || sees_lights_))
      add_found(
          connect_hit(found_light(), subpath_, s, d2, Vertex::kMedia ? 0 : depth_, transmittance),
          transmittance);
    const bool is_last =
        depth_ == pilot_.max_depth &&
        !(Vertex::kMedia && scene_.materials[s.shape->material]->passes_straight());
    if (is_last || !(cosine > 0)) return false;
    arrive_at({s.position, d2, cosine, transmittance});
    if constexpr (Vertex::kMedia)
      return leave_vertex(Vertex(scene_, s, -subpath_.ray.direction,
                                 {subpath_.throughput, Partials{}, depth_}, subpath_.medium));
    else
      return leave_vertex(
          Vertex(scene_, s, -subpath_.ray.direction, subpath_.throughput, Partials{}, depth_));
  }

  void arrive_at(const Arrival& a) {
    if (depth_ == 1) first_eye_partials(scene_, camera_ray_, a, pilot_.set, subpath_);
    record_arrival(subpath_, a.d2 / a.transmittance, a.cosine);
  }

  void add(const Spectrum& v, Technique technique, float blur = 0) {
    const size_t before = out_.eye.size();
    add_contribution(out_.eye, v, weights_.shares(), technique, cell_, blur);
    if (out_.eye.size() > before) out_.eye.back().shared = shared_;
  }

  /// Light at the end of the sub-path.
  void add_found(const Connection& connection, float transmittance) {
    const Spectrum v = connection.value * connection.weight;
    if (depth_ > 1 || transmittance < 1)
      add(v, Technique::unidirectional);
    else if (is_finite(v))
      seen_ += double(v.r + v.g + v.b) / 3;
  }

  /// Connects a vertex with all that there is, and scatters; whether the sub-path goes on.
  bool leave_vertex(const Vertex& v) {
    weights_.set_eye(pdfs_);
    if constexpr (!Vertex::kMedia)
      if (depth_ == 2)
        shared_ =
            !subpath_.from_specular && ConnectionVertex(v).material == ConnectionVertex::kDiffuse;
    if (v.is_smooth() && depth_ < pilot_.max_depth) {
      sampler_.start_dimension(dimension_);
      ConnectionRoulette none(0, 0);  // path tracing has none
      const Connection direct = connect_light(connections(none, counters()), v, sampler_);
      add(direct.value * direct.weight, Technique::unidirectional);
      connect(v);
      if (v.merges()) merge(v);
    }
    sampler_.start_dimension(dimension_ + kScatteringDimension);
    dimension_ += kDimensionsPerVertex;
    bool straight = false;
    if (!scatter<Transport::radiance>(v, pilot_.set, pilot_.options, sampler_, subpath_, &straight))
      return false;
    first_ &= subpath_.unmerged;
    sees_lights_ |= !straight;
    return (Vertex::kMedia && straight) || ++depth_ <= pilot_.max_depth;
  }

  ConnectionContext<FamilyWeights> connections(ConnectionRoulette& roulette,
                                               RenderCounters& counters) {
    return {scene_,   LightStarts(scene_, pilot_.guide.get()),
            weights_, roulette,
            counters, pilot_.plan.strict_normals,
            &shadows_};
  }
  ConnectionContext<FamilyWeights> found_light() { return connections(roulette_, counters()); }

  void connect(const Vertex& v) {
    // Another one at each vertex, as in SubpathSharing, and never one of the pixel's other
    // sub-path.
    const size_t subpath = (index_ + 2 * size_t(v.depth - 1)) % pilot_.light.vertex_ends.size();
    const std::span<const VertexPdfs> pdfs = pilot_.light.pdfs(subpath);
    const size_t first = pilot_.light.first_vertex(subpath);
    for (size_t i = first; i < pilot_.light.vertex_ends[subpath]; ++i) {
      const LightVertex& packed = pilot_.light.vertices[i];
      if (int(packed.depth) + v.depth + 1 > pilot_.max_depth) break;
      weights_.set_light(pdfs, &pilot_.light.arrivals[i].ends);
      const Connection connection = connect_ends(connections(roulette_, out_.connection_counters),
                                                 packed.template unpack<Vertex>(scene_), v);
      add(connection.value * connection.weight, Technique::connection);
    }
  }

  /// The two sub-paths of a pixel meet different photons, so that they are independent.
  void merge(const Vertex& v) {
    const float kernel = 1 / (pilot_.set.merge_area * pilot_.set.light_paths);
    const PhotonShift shift{pilot_.shift_scale, to_unit_float(uint32_t(mix64(kEdgeSeed + cell_)))};
    RenderCounters& counters = out_.merge_counters;
    ++counters.merge_queries;
    out_.first_counters.merge_queries += first_;
    const uint64_t random = mix64(hash_combine(kGapSeed ^ pilot_.plan.seed,
                                               index_ * kMostVerticesOfSubpath + size_t(v.depth)));
    const Point2f beside{to_unit_float(uint32_t(random)), to_unit_float(uint32_t(random >> 32))};
    const float missing =
        lacks_photons(scene_, v, pilot_.first_radius, beside, counters) ? 1.0f : 0.0f;
    const PilotLightSubpaths& light = pilot_.light;
    pilot_.grid.query(v.position(), pilot_.grid.locate(v.position()), [&](uint32_t i, float) {
      const LightVertex& photon = light.vertices[i];
      if (int(photon.depth) + v.depth > pilot_.max_depth || (light.owner[i] ^ index_) & 1) return;
      weights_.set_light(light.pdfs(light.owner[i]), &light.arrivals[i].ends);
      const Connection connection =
          connect_merge(weights_, photon, v, kernel, pilot_.plan.strict_normals);
      if (connection.value.is_black()) return;
      ++counters.merges;
      out_.first_counters.merges += first_;
      add(connection.value * connection.weight,
          first_ ? Technique::first_merge : Technique::later_merge,
          merge_blur(scene_, v, photon.position, light.arrivals[i], shift, counters) - missing);
    });
  }

  const PilotSetup& pilot_;
  const Scene& scene_;
  size_t index_;
  uint64_t key_;
  uint16_t cell_;
  PricingRecord& out_;
  double& seen_;
  Sampler sampler_;
  Ray camera_ray_;
  SubpathPdfs pdfs_;
  SubpathOf<Vertex> subpath_;
  FamilyWeights weights_;
  ConnectionRoulette roulette_;
  RandomStream shadows_;  ///< for shadow rays through media
  int depth_ = 1;
  uint32_t dimension_ = kFirstVertexDimension;
  bool first_ = true;    ///< Walk::unmerged
  bool shared_ = false;  ///< PilotSample::shared of what is found from here on
  /// Lights are not to be seen before light has been scattered if emitters are hidden.
  bool sees_lights_;
};

}  // namespace

void add_contribution(std::vector<PilotSample>& to, const Spectrum& v, const FamilyShares& shares,
                      Technique technique, uint16_t cell, float blur) {
  if (v.is_black() || !is_finite(v)) return;
  const float value = (v.r + v.g + v.b) * (1 / 3.0f);
  const float square = (v.r * v.r + v.g * v.g + v.b * v.b) * (1 / 3.0f);
  if (!std::isfinite(square) || !std::isfinite(shares.unidirectional + shares.merges)) return;
  to.push_back({value, square, shares, technique, blur, cell});
}

template <class Vertex>
void trace_pilot_eye_subpath(const PilotSetup& pilot, size_t index, PricingRecord& out,
                             double& seen) {
  PilotEyeSubpath<Vertex>(pilot, index, out, seen).trace();
}

template void trace_pilot_eye_subpath<PathVertex>(const PilotSetup&, size_t, PricingRecord&,
                                                  double&);
template void trace_pilot_eye_subpath<MediaVertex>(const PilotSetup&, size_t, PricingRecord&,
                                                   double&);

}  // namespace duet
