// Weights by all densities of a path against those by running sums, which weights_test.cpp holds
// against the definition; and the shares of families against what is left without them.
#include "transport/family_weights.h"

#include <cmath>

#include "support/transport_scene.h"
#include "transport/light_walk.h"
#include "transport/weights.h"

using namespace duet;
using namespace duet::test;

namespace {

constexpr int kDepth = 6;

std::vector<std::string> scenes() {
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

/// The weight of a join, and the shares of families if they are known. Techniques: `u` path
/// tracing, `c` seen from the camera, `v` connection, `f` merge where FamilyShares::first_merge is,
/// `m` later merge.
struct Observation {
  char technique;
  float weight;
  FamilyShares shares;
};

/// FamilyWeights of walks that still grow.
struct Growing {
  const Trail* light;
  const Trail* eye;
  mutable FamilyWeights weights;

  FamilyWeights& update() const {
    weights.set_light(*light);
    weights.set_eye(*eye);
    return weights;
  }
  float hit(const Walk& w, float direct, float emission) const {
    return update().hit(w, direct, emission);
  }
  float light_sample(const PathVertex& v, float direct, float bsdf, const JoinEnd& end) const {
    return update().light_sample(v, direct, bsdf, end);
  }
  float camera(const PathVertex& v, const JoinEnd& end) const { return update().camera(v, end); }
  float connection(const PathVertex& l, const JoinEnd& light_end, const PathVertex& e,
                   const JoinEnd& eye_end) const {
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

/// All joins of a light walk and an eye walk that are the same for every kind of weights.
template <class Weights>
std::vector<Observation> observe(const Scene& scene, const TechniqueSet& set, uint32_t index,
                                 const Weights& weights, Trail& light_trail, Trail& eye_trail) {
  std::vector<Observation> all;
  const auto note = [&](char technique, const Join& join) {
    if (!join.value.is_black()) all.push_back({technique, join.weight, shares_of(weights)});
  };
  RenderCounters counters;
  JoinRoulette roulette(0, 0);
  std::vector<PathVertex> light;
  std::vector<LightVertex> packed;
  Sampler light_sampler(SampleSequence::independent, 1, 0, index);
  light_sampler.start_sample(0);
  trace_light_walk(scene, set, {1000, false}, kDepth, light_sampler, counters, &light_trail,
                   [&](const PathVertex& v, const Hit& hit) {
                     if (!v.bsdf.has_smooth()) return;
                     light.push_back(v), packed.emplace_back(v, hit);
                     const auto seen =
                         join_camera(scene, weights, v, {}, false, roulette, counters);
                     if (seen) note('c', seen->join);
                   });
  Sampler sampler(SampleSequence::independent, 2, 0, index);
  sampler.start_sample(0);
  const Ray camera_ray =
      scene.camera->sample_ray({32 * sampler.next_1d(), 32 * sampler.next_1d()}, {});
  eye_trail.assign(1, TrailVertex{1, 0, 1, false});
  Walk walk;
  walk.ray = camera_ray;
  walk.from = camera_ray.origin;
  walk.throughput = Spectrum(1);
  walk.trail = &eye_trail;
  char merge = 'f';
  for (int depth = 1; depth <= kDepth; ++depth) {
    Hit hit;
    if (!scene.accel->closest_hit(walk.ray, hit)) {
      if (scene.environment) note('u', join_escape(scene, weights, walk));
      break;
    }
    const Surface s = scene.surface(walk.ray, hit);
    const float d2 = hit.t * hit.t, cosine = std::abs(dot(s.ng, walk.ray.direction));
    if (s.shape->light != kNone) note('u', join_hit(scene, weights, walk, s, d2));
    if (!(cosine > 0)) break;
    const Partials partials =
        depth == 1 ? first_eye_partials(scene, camera_ray, s.position, d2, cosine, set, walk)
                   : arrive(walk.partials, d2, cosine, set.walk_connections());
    record_arrival(walk, d2, cosine);
    const PathVertex v(scene, s, -walk.ray.direction, walk.throughput, partials, depth);
    if (v.bsdf.has_smooth()) {
      Sampler same = sampler;
      note('u', join_light(scene, weights, v, false, same, roulette, counters));
      for (const PathVertex& l : light)
        note('v', join_ends(scene, weights, l, v, false, roulette, counters));
      // How far the two vertices are apart does not matter to the weight.
      if (v.merges())
        for (const LightVertex& l : packed)
          if (l.merges) note(merge, join_merge(weights, l, v, 1, false));
    }
    sampler.start_dimension(8 * uint32_t(depth));
    if (!scatter<Transport::radiance>(v, set, {1000, false}, sampler, walk)) break;
    if (!walk.unmerged) merge = 'm';
  }
  return all;
}

bool agree(double a, double b) {
  return std::abs(a - b) < 1e-3 * std::max(a, b) + 1e-5;
}

}  // namespace

TEST_CASE("weights by families of techniques are those of VCM, and so are the shares") {
  int compared = 0, differ = 0, shares_differ = 0, merges = 0, first_merges = 0;
  for (const std::string& content : scenes()) {
    const TransportScene s(content);
    TechniqueSet all;
    all.hits = all.light_samples = all.camera_joins = all.connections = all.merges = true;
    all.light_paths = 500;
    all.merge_area = 0.002f;
    TechniqueSet no_merges = all;
    no_merges.merges = false;
    TechniqueSet no_light_image = no_merges;
    no_light_image.camera_joins = false;
    for (uint32_t i = 0; i < 1500; ++i) {
      Trail light, eye;
      const auto with = [&](const TechniqueSet& set) {
        return observe(*s.scene, set, i, BalanceWeights(set), light, eye);
      };
      const auto a = with(all), b = with(no_merges), c = with(no_light_image);
      const auto families =
          observe(*s.scene, all, i, Growing{&light, &eye, FamilyWeights(all)}, light, eye);
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
