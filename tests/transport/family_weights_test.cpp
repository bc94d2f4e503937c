// Weights by all densities of a path against those by running sums, which weights_test.cpp holds
// against the definition; and the shares of families against what is left without them.
#include "transport/family_weights.h"

#include <cmath>

#include "support/transport_scene.h"
#include "transport/light_subpath.h"
#include "transport/weights.h"

using namespace duet;
using namespace duet::test;

namespace {

constexpr int kDepth = 6;

std::vector<std::string> family_scenes() {
  const std::string camera = camera_xml("0, -3, 1", "0, 0, 1", 32);
  const std::string walls = room_xml(grey("0.7, 0.5, 0.3"));
  const std::string glass = sphere_xml("-0.4, 0, 0.4", "0.4", "<bsdf type='dielectric'/>");
  const std::string metal = sphere_xml(
      "0.5, 0, 0.4", "0.4", "<bsdf type='roughconductor'><float name='alpha' value='0.2'/></bsdf>");
  const std::string point =
      "<emitter type='point'><point name='position' value='0.2, 0.1, 1.6'/></emitter>";
  const std::string sky = "<emitter type='constant'/>";
  const std::string sun =
      "<emitter type='directional'><vector name='direction' value='0.2, 1, -0.4'/></emitter>";
  const std::string lamp = lamp_xml("0.3", "12");
  const std::string sharp =
      sphere_xml("0.5, 0, 0.4", "0.4",
                 "<bsdf type='roughconductor'><float name='alpha' value='0.04'/></bsdf>") +
      sphere_xml("-0.4, 0, 0.4", "0.4",
                 "<bsdf type='roughdielectric'><float name='alpha' value='0.03'/></bsdf>");
  return {camera + walls + lamp + glass, camera + walls + point + metal + glass,
          camera + walls + lamp + point + sharp, camera + walls + sun + sky + metal,
          camera + room_xml("<bsdf type='plastic'/>") + lamp + glass};
}

/// Fog, with a pane that light partly passes straight in it, and photons on the walls.
std::vector<std::string> foggy_family_scenes() {
  const std::string pane =
      "<shape type='rectangle'><transform name='to_world'><rotate x='1' angle='80'/>"
      "<scale value='0.5'/><translate y='-0.4' z='0.8'/></transform><bsdf type='mask'><float "
      "name='opacity' value='0.4'/>" +
      grey("0.6, 0.5, 0.4") + "</bsdf></shape>";
  std::vector<std::string> foggy;
  for (const std::string sigma : {"0.4", "0.9, 0.3, 0.1"}) {
    const std::string fog = "<medium type='homogeneous' id='fog'><rgb name='sigma_t' value='" +
                            sigma +
                            "'/><rgb name='albedo' value='0.9'/></medium><shape type='cube'>"
                            "<transform name='to_world'><scale value='4'/></transform>"
                            "<bsdf type='null'/><ref id='fog' name='interior'/></shape>";
    for (const std::string& content : family_scenes()) foggy.push_back(content + fog + pane);
  }
  return foggy;
}

/// The weight of a connection, and the shares of families if they are known. Techniques: `u` path
/// tracing, `c` seen from the camera, `v` connection, `f` merge where FamilyShares::first_merge is,
/// `m` later merge.
struct Observation {
  char technique;
  float weight;
  FamilyShares shares;
};

/// FamilyWeights of sub-paths that still grow.
struct Growing {
  const SubpathPdfs* light;
  const SubpathPdfs* eye;
  mutable FamilyWeights weights;
  /// Of the light vertex at hand.
  mutable const EndPdfs* ends = nullptr;

  FamilyWeights& update() const {
    weights.set_light(*light, ends);
    weights.set_eye(*eye);
    return weights;
  }
  float hit(const Subpath& w, float direct, float emission, const LightSampleVariance& v) const {
    return update().hit(w, direct, emission, v);
  }
  float light_sample(const PathVertex& v, float direct, float bsdf,
                     const ConnectionEnd& end) const {
    return update().light_sample(v, direct, bsdf, end);
  }
  float camera(const PathVertex& v, const ConnectionEnd& end) const {
    return update().camera(v, end);
  }
  float connection(const PathVertex& l, const ConnectionEnd& light_end, const PathVertex& e,
                   const ConnectionEnd& eye_end) const {
    return update().connection(l, light_end, e, eye_end);
  }
  float merge(const LightVertex& l, float light_reverse, const PathVertex& e,
              float eye_reverse) const {
    return update().merge(l, light_reverse, e, eye_reverse);
  }
};

FamilyShares shares_of(const Growing& w) {
  return w.weights.shares();
}
FamilyShares shares_of(const BalanceWeights&) {
  return {};
}
void set_ends(const Growing& w, const EndPdfs* ends) {
  w.ends = ends;
}
void set_ends(const BalanceWeights&, const EndPdfs*) {}

/// All connections of a light sub-path and an eye sub-path that are the same for every kind of
/// weights.
template <class Vertex, class Weights>
class Observer {
 public:
  Observer(const Scene& scene, const TechniqueSet& set, uint32_t index, const Weights& weights,
           SubpathPdfs& light_pdfs, SubpathPdfs& eye_pdfs)
      : scene_(scene),
        set_(set),
        index_(index),
        weights_(weights),
        light_pdfs_(light_pdfs),
        eye_pdfs_(eye_pdfs),
        random_(index) {}

  std::vector<Observation> run() {
    trace_light();
    trace_eye();
    return std::move(all_);
  }

 private:
  void note(char technique, const Connection& connection) {
    if (!connection.value.is_black())
      all_.push_back({technique, connection.weight, shares_of(weights_)});
  }

  ConnectionContext<Weights> connections() {
    return {scene_, LightStarts(scene_), weights_, roulette_, counters_, false, &random_};
  }

  void trace_light() {
    Sampler sampler(SampleSequence::independent, 1, 0, index_);
    sampler.start_sample(0);
    trace_light_subpath<Vertex>({scene_,
                                 LightStarts(scene_),
                                 set_,
                                 {1000, false},
                                 kDepth,
                                 sampler,
                                 counters_,
                                 &light_pdfs_,
                                 uint64_t(index_)},
                                [&](const Vertex& v, const Hit& hit) {
                                  if (!v.is_smooth()) return;
                                  light_.push_back(v), packed_.emplace_back(v, hit);
                                  ends_.push_back({light_pdfs_.front(), light_pdfs_.back()});
                                  const auto seen = connect_camera(connections(), v, {}, false);
                                  if (seen) note('c', seen->connection);
                                });
  }

  SubpathOf<Vertex> new_subpath() const {
    if constexpr (Vertex::kMedia)
      return MediaSubpath(scene_, Subpath(), scene_.camera_medium, ~uint64_t(index_));
    else
      return Subpath();
  }

  void trace_eye() {
    Sampler sampler(SampleSequence::independent, 2, 0, index_);
    sampler.start_sample(0);
    const Ray camera_ray =
        scene_.camera->sample_ray({32 * sampler.next_1d(), 32 * sampler.next_1d()}, {});
    eye_pdfs_.assign(1, VertexPdfs{1, 0, 1, false});
    SubpathOf<Vertex> subpath = new_subpath();
    subpath.ray = camera_ray;
    subpath.from = camera_ray.origin;
    subpath.throughput = Spectrum(1);
    subpath.pdfs = &eye_pdfs_;
    int depth = 1;
    const auto arrive_at = [&](const Arrival& a) {
      const Partials partials = depth == 1
                                    ? first_eye_partials(scene_, camera_ray, a, set_, subpath)
                                    : arrive(subpath.partials, a.d2 / a.transmittance, a.cosine,
                                             set_.subpath_connections());
      record_arrival(subpath, a.d2 / a.transmittance, a.cosine);
      return partials;
    };
    uint32_t dimension = 0;
    const auto pass = [&](const Vertex& v) {
      connection(v, sampler);
      sampler.start_dimension(dimension += 8);
      bool straight = false;
      if (!scatter<Transport::radiance>(v, set_, {1000, false}, sampler, subpath, &straight))
        return false;
      if (!subpath.unmerged) merge_ = 'm';
      return (Vertex::kMedia && straight) || ++depth <= kDepth;
    };
    for (;;) {
      Hit hit;
      const bool found = scene_.accel->closest_hit(subpath.ray, hit);
      float transmittance = 1;
      if constexpr (Vertex::kMedia) {
        Ray segment = subpath.ray;
        if (found) segment.tmax = hit.t;
        const float t = subpath.cross(segment, sampler.next_1d(), counters_);
        transmittance = subpath.counted_transmittance();
        if (t < INFINITY) {
          const Point3f p = subpath.ray.origin + subpath.ray.direction * t;
          const float extinction = subpath.medium->nominal_extinction(p);
          const Partials partials =
              arrive_at({p, length_squared(p - subpath.from), extinction, transmittance});
          if (!pass(Vertex({*subpath.medium, extinction, p}, -subpath.ray.direction,
                           {subpath.throughput, partials, depth})))
            return;
          continue;
        }
      }
      if (!found) {
        if (scene_.environment) note('u', connect_escape(connections(), subpath, transmittance));
        return;
      }
      const Surface s = scene_.surface(subpath.ray, hit);
      const float d2 = length_squared(s.position - subpath.from);
      const float cosine = std::abs(dot(s.ng, subpath.ray.direction));
      if (s.shape->light != kNone)
        note('u',
             connect_hit(connections(), subpath, s, d2, Vertex::kMedia ? 0 : depth, transmittance));
      if (!(cosine > 0)) return;
      const Partials partials = arrive_at({s.position, d2, cosine, transmittance});
      if constexpr (Vertex::kMedia) {
        if (!pass(Vertex(scene_, s, -subpath.ray.direction, {subpath.throughput, partials, depth},
                         subpath.medium)))
          return;
      } else if (!pass(Vertex(scene_, s, -subpath.ray.direction, subpath.throughput, partials,
                              depth))) {
        return;
      }
    }
  }

  void connection(const Vertex& v, const Sampler& sampler) {
    if (!v.is_smooth()) return;
    Sampler same = sampler;
    note('u', connect_light(connections(), v, same));
    for (size_t i = 0; i < light_.size(); ++i) {
      set_ends(weights_, &ends_[i]);
      note('v', connect_ends(connections(), light_[i], v));
      // How far the two vertices are apart does not matter to the weight.
      if (v.merges() && packed_[i].merges)
        note(merge_, connect_merge(weights_, packed_[i], v, 1, false));
    }
    set_ends(weights_, nullptr);
  }

  const Scene& scene_;
  const TechniqueSet& set_;
  uint32_t index_;
  const Weights& weights_;
  SubpathPdfs &light_pdfs_, &eye_pdfs_;
  RandomStream random_;
  RenderCounters counters_;
  ConnectionRoulette roulette_{0, 0};
  std::vector<Vertex> light_;
  std::vector<LightVertex> packed_;
  std::vector<EndPdfs> ends_;
  char merge_ = 'f';
  std::vector<Observation> all_;
};

bool agree(double a, double b) {
  return std::abs(a - b) < 1e-3 * std::max(a, b) + 1e-5;
}

template <class Vertex>
void compare_weights(const std::vector<std::string>& contents) {
  int compared = 0, differ = 0, shares_differ = 0, merges = 0, first_merges = 0;
  for (const std::string& content : contents) {
    const TransportScene s(content);
    TechniqueSet all;
    all.hits = all.light_samples = all.camera_connections = all.connections = all.merges = true;
    all.light_paths = 500;
    all.merge_area = 0.002f;
    TechniqueSet no_merges = all;
    no_merges.merges = false;
    TechniqueSet no_light_image = no_merges;
    no_light_image.camera_connections = false;
    for (uint32_t i = 0; i < 1500; ++i) {
      SubpathPdfs light, eye;
      const auto with = [&](const TechniqueSet& set) {
        const BalanceWeights sums(set);
        return Observer<Vertex, BalanceWeights>(*s.scene, set, i, sums, light, eye).run();
      };
      const auto a = with(all), b = with(no_merges), c = with(no_light_image);
      const Growing growing{&light, &eye, FamilyWeights(all)};
      const auto families = Observer<Vertex, Growing>(*s.scene, all, i, growing, light, eye).run();
      REQUIRE(families.size() == a.size());
      for (size_t k = 0; k < a.size(); ++k) {
        const FamilyShares& f = families[k].shares;
        ++compared;
        differ += !agree(double(families[k].weight), double(a[k].weight));
        shares_differ +=
            !agree(double(f.unidirectional + f.light_image + f.connections + f.merges), 1);
        shares_differ += f.first_merge > f.merges * 1.0001f;
        if (a[k].technique == 'f') {
          ++first_merges;
          shares_differ += !agree(double(families[k].weight), double(f.first_merge));
        } else if (a[k].technique == 'm') {
          ++merges;
          shares_differ += families[k].weight > (f.merges - f.first_merge) * 1.001f + 1e-5f;
        } else {
          shares_differ += !agree(double(families[k].weight), double(b[k].weight * (1 - f.merges)));
        }
        if (a[k].technique == 'u')
          shares_differ += !agree(double(b[k].weight * (1 - f.merges)),
                                  double(c[k].weight * (1 - f.merges - f.light_image)));
      }
    }
  }
  CHECK(compared > 50000);
  CHECK(merges > 5000);
  CHECK(first_merges > 5000);
  // Chains of grazing vertices differ by the rounding of single precision.
  CHECK(differ < 2e-3 * compared);
  CHECK(shares_differ < 2e-3 * compared);
}

}  // namespace

TEST_CASE("weights by families of techniques are those of VCM, and so are the shares") {
  compare_weights<PathVertex>(family_scenes());
}

TEST_CASE("weights by families of techniques are those of VCM where there are media") {
  compare_weights<MediaVertex>(foggy_family_scenes());
}
