#include "integrators/pricing_pilot.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "integrators/camera_integrator.h"
#include "integrators/merge_blur.h"
#include "integrators/next_event.h"
#include "integrators/pilot.h"
#include "transport/light_walk.h"
#include "transport/vertex_grid.h"

namespace duet {

namespace {

constexpr uint64_t kEyeSeed = 0x7072696365ull, kLightSeed = 0x6c69676874ull,
                   kEdgeSeed = 0x65646765ull, kGapSeed = 0x676170ull;
/// Longer paths add next to nothing to what the pilot is asked.
constexpr int kLongest = FamilyWeights::kMostVertices / 2;
constexpr size_t kWalksPerBlock = 64;

class PricingPilot {
 public:
  PricingPilot(const Scene& scene, const PricingPlan& plan)
      : scene_(scene),
        plan_(plan),
        walks_(2 * size_t(plan.pixels_per_side) * plan.pixels_per_side) {
    max_depth_ = plan.max_depth < 0 ? kLongest : std::min(plan.max_depth, kLongest);
    options_ = {plan.rr_depth, plan.strict_normals};
    const double pixels = double(plan.film.x) * plan.film.y;
    set_.hits = set_.light_samples = set_.camera_joins = set_.connections = set_.merges = true;
    set_.light_paths = float(PricingRecord::kLightPaths * pixels);
    LightPassPlan light;
    light.set = set_;
    light.walk = options_;
    light.max_depth = max_depth_ - 1;
    light.hide_emitters = plan.hide_emitters;
    light.seed = kEyeSeed ^ plan.seed;
    light.threads = plan.threads;
    const Pilot sizes = run_pilot(scene, plan.film, light);
    const double radius = sizes.first_radius();
    set_.merge_area = kPi * sqr(float(radius));
    threshold_ = sizes.roulette_threshold();
    // There are fewer walks than an iteration has, of which an eye walk meets every second one:
    // with a larger radius the share of pairs is the one that is meant.
    const double thinned = double(walks_) / pixels;
    query_radius_ = float(radius * std::sqrt(2 * PricingRecord::kMergeShare / thinned));
    first_radius_ = float(radius);
    shift_scale_ = float(std::min(1.0, radius / double(query_radius_)));
  }

  PricingRecord run() {
    record_.side = plan_.pixels_per_side;
    record_.seen.resize(walks_ / 2);
    trace_light();
    grid_.build(
        uint32_t(light_.vertices.size()),
        [&](uint32_t i) {
          const LightVertex& v = light_.vertices[i];
          return v.merges ? v.position : VertexGrid::nowhere();
        },
        query_radius_, plan_.threads);
    trace_eye();
    return std::move(record_);
  }

 private:
  struct Block {
    PricingRecord record;
    PilotLightWalks light;
  };
  /// What contributions of an eye walk under way have in common.
  struct EyeState {
    uint16_t cell;
    bool first = true;  ///< Walk::unmerged
  };

  uint16_t cell(const Point2f& film) const {
    const int side = plan_.pixels_per_side;
    const auto index = [&](float x, int size) {
      return std::clamp(int(double(x) / size * side), 0, side - 1);
    };
    return uint16_t(index(film.y, plan_.film.y) * side + index(film.x, plan_.film.x));
  }

  static void add(std::vector<PricedContribution>& to, const Spectrum& v,
                  const FamilyShares& shares, Technique technique, uint16_t cell, float blur = 0) {
    if (v.is_black() || !is_finite(v)) return;
    const float value = (v.r + v.g + v.b) * (1 / 3.0f);
    const float square = (v.r * v.r + v.g * v.g + v.b * v.b) * (1 / 3.0f);
    if (!std::isfinite(square) || !std::isfinite(shares.unidirectional + shares.merges)) return;
    to.push_back({value, square, shares, technique, blur, cell});
  }

  void trace_light() {
    std::vector<Block> blocks((walks_ + kWalksPerBlock - 1) / kWalksPerBlock);
    parallel_for(blocks.size(), plan_.threads, [&](size_t b) {
      const size_t end = std::min((b + 1) * kWalksPerBlock, walks_);
      for (size_t i = b * kWalksPerBlock; i < end; ++i) light_walk(i, blocks[b]);
    });
    for (const Block& b : blocks) {
      light_.append(b.light);
      record_.light_counters.add(b.record.light_counters);
      record_.light.insert(record_.light.end(), b.record.light.begin(), b.record.light.end());
    }
    record_.light_vertices = double(light_.vertices.size());
  }

  void light_walk(size_t index, Block& block) {
    Sampler sampler(SampleSequence::independent, kLightSeed ^ plan_.seed, 0, index);
    sampler.start_sample(0);
    JoinRoulette roulette(threshold_ * set_.light_paths,
                          hash_combine(kLightSeed ^ plan_.seed, index));
    RenderCounters& counters = block.record.light_counters;
    Trail trail;
    FamilyWeights weights(set_);
    const auto visit = [&](const PathVertex& v, const Hit& hit) {
      if (!v.bsdf.has_smooth()) return;
      block.light.add(v, hit);
      weights.set_light(trail);
      const auto seen =
          join_camera(scene_, weights, v, scene_.camera->has_lens() ? sampler.next_2d() : Point2f{},
                      plan_.hide_emitters, roulette, counters);
      if (seen)
        add(block.record.light, seen->join.value * (seen->join.weight / set_.light_paths),
            weights.shares(), Technique::light_image, cell(seen->film));
    };
    trace_light_walk(scene_, set_, options_, max_depth_ - 1, sampler, counters, &trail, visit);
    block.light.end_walk(trail);
  }

  void trace_eye() {
    std::vector<Block> blocks((walks_ + kWalksPerBlock - 1) / kWalksPerBlock);
    parallel_for(blocks.size(), plan_.threads, [&](size_t b) {
      const size_t end = std::min((b + 1) * kWalksPerBlock, walks_);
      for (size_t i = b * kWalksPerBlock; i < end; ++i) {
        eye_walk(i, blocks[b].record);
        blocks[b].record.ends.push_back(uint32_t(blocks[b].record.eye.size()));
      }
    });
    for (const Block& b : blocks) {
      const uint32_t first = uint32_t(record_.eye.size());
      record_.eye.insert(record_.eye.end(), b.record.eye.begin(), b.record.eye.end());
      for (const uint32_t e : b.record.ends) record_.ends.push_back(first + e);
      record_.eye_counters.add(b.record.eye_counters);
      record_.connection_counters.add(b.record.connection_counters);
      record_.merge_counters.add(b.record.merge_counters);
      record_.first_counters.add(b.record.first_counters);
    }
  }

  /// Where the walk's pixel lies: one in each cell of a grid, the same for two walks in succession.
  Point2f pixel(size_t walk) const {
    const size_t cell = walk / 2, side = size_t(plan_.pixels_per_side);
    const uint64_t random = mix64(hash_combine(kEyeSeed ^ plan_.seed, cell));
    const auto place = [&](size_t at, uint64_t bits, int size) {
      const double x = (double(at) + double(to_unit_float(uint32_t(bits)))) / double(side) * size;
      return std::min(float(std::floor(x)), float(size - 1));
    };
    return {place(cell % side, random, plan_.film.x),
            place(cell / side, random >> 32, plan_.film.y)};
  }

  void eye_walk(size_t index, PricingRecord& out) {
    Sampler sampler(SampleSequence::independent, kEyeSeed ^ plan_.seed, 0, index);
    sampler.start_sample(0);
    const Point2f u = sampler.next_2d();
    const Point2f corner = pixel(index), film{corner.x + u.x, corner.y + u.y};
    sampler.start_dimension(kLensDimension);
    const Point2f lens = scene_.camera->has_lens() ? sampler.next_2d() : Point2f{};
    const Ray camera_ray = scene_.camera->sample_ray(film, lens);
    RenderCounters& counters = out.eye_counters;
    ++counters.camera_paths;
    EyeState at{uint16_t(index / 2)};
    Trail trail{{1, 0, 1, false}};
    Walk walk;
    walk.ray = plan_.hide_emitters ? behind_emitters(scene_, camera_ray, counters) : camera_ray;
    walk.from = walk.ray.origin;
    walk.throughput = Spectrum(1);
    walk.trail = &trail;
    FamilyWeights weights(set_);
    JoinRoulette roulette(threshold_, hash_combine(kEyeSeed ^ plan_.seed, index));
    bool sees_sky = !plan_.hide_emitters;  // not before light has been scattered
    for (int depth = 1; depth <= max_depth_; ++depth) {
      weights.set_eye(trail);
      const auto found = [&](const Join& join) {
        const Spectrum v = join.value * join.weight;
        if (depth > 1)
          add(out.eye, v, weights.shares(), Technique::unidirectional, at.cell);
        else if (is_finite(v))
          record_.seen[at.cell] += double(v.r + v.g + v.b) / 3;  // no other block has the cell
      };
      Hit hit;
      ++counters.closest_rays;
      out.first_counters.closest_rays += at.first;
      if (!scene_.accel->closest_hit(walk.ray, hit)) {
        if (scene_.environment && sees_sky) found(join_escape(scene_, weights, walk));
        return;
      }
      ++counters.path_vertices;
      const Surface s = scene_.surface(walk.ray, hit);
      const float d2 = hit.t * hit.t, cosine = std::abs(dot(s.ng, walk.ray.direction));
      if (s.shape->light != kNone) found(join_hit(scene_, weights, walk, s, d2));
      if (depth == max_depth_ || !(cosine > 0)) return;
      if (depth == 1) first_eye_partials(scene_, camera_ray, s.position, d2, cosine, set_, walk);
      record_arrival(walk, d2, cosine);
      weights.set_eye(trail);
      const PathVertex v(scene_, s, -walk.ray.direction, walk.throughput, {}, depth);
      const uint32_t dimension = kFirstVertexDimension + kDimensionsPerVertex * uint32_t(depth - 1);
      if (v.bsdf.has_smooth()) {
        sampler.start_dimension(dimension);
        JoinRoulette none(0, 0);  // path tracing has none
        const Join direct =
            join_light(scene_, weights, v, plan_.strict_normals, sampler, none, counters);
        add(out.eye, direct.value * direct.weight, weights.shares(), Technique::unidirectional,
            at.cell);
        connect(index, v, weights, roulette, at, out);
        if (v.merges()) merge(index, v, weights, at, out);
      }
      sampler.start_dimension(dimension + kScatteringDimension);
      bool straight = false;
      if (!scatter<Transport::radiance>(v, set_, options_, sampler, walk, &straight)) return;
      at.first &= walk.unmerged;
      sees_sky |= !straight;
    }
  }

  void connect(size_t index, const PathVertex& v, FamilyWeights& weights, JoinRoulette& roulette,
               const EyeState& at, PricingRecord& out) const {
    weights.set_light(light_.trail(index));
    for (const LightVertex& packed : light_.walk(index)) {
      if (int(packed.depth) + v.depth + 1 > max_depth_) break;
      const Join join = join_ends(scene_, weights, packed.unpack(scene_), v, plan_.strict_normals,
                                  roulette, out.connection_counters);
      add(out.eye, join.value * join.weight, weights.shares(), Technique::connection, at.cell);
    }
  }

  /// The two walks of a pixel meet different photons, so that they are independent.
  void merge(size_t index, const PathVertex& v, FamilyWeights& weights, const EyeState& at,
             PricingRecord& out) const {
    const float kernel = 1 / (set_.merge_area * set_.light_paths);
    const PhotonShift shift{shift_scale_, to_unit_float(uint32_t(mix64(kEdgeSeed + at.cell)))};
    ++out.merge_counters.merge_queries;
    out.first_counters.merge_queries += at.first;
    const uint64_t random =
        mix64(hash_combine(kGapSeed ^ plan_.seed, index * kLongest + size_t(v.depth)));
    const Point2f beside{to_unit_float(uint32_t(random)), to_unit_float(uint32_t(random >> 32))};
    const float missing =
        lacks_photons(scene_, v, first_radius_, beside, out.merge_counters) ? 1.0f : 0.0f;
    grid_.query(v.position(), grid_.locate(v.position()), [&](uint32_t i, float) {
      const LightVertex& photon = light_.vertices[i];
      if (int(photon.depth) + v.depth > max_depth_ || (light_.owner[i] ^ index) & 1) return;
      weights.set_light(light_.trail(light_.owner[i]));
      const Join join = join_merge(weights, photon, v, kernel, plan_.strict_normals);
      if (join.value.is_black()) return;
      ++out.merge_counters.merges;
      out.first_counters.merges += at.first;
      add(out.eye, join.value * join.weight, weights.shares(),
          at.first ? Technique::first_merge : Technique::later_merge, at.cell,
          merge_blur(scene_, v, photon.position, light_.arrivals[i], shift, out.merge_counters) -
              missing);
    });
  }

  const Scene& scene_;
  PricingPlan plan_;
  size_t walks_;
  int max_depth_;
  WalkOptions options_;
  TechniqueSet set_;
  float threshold_ = 0, query_radius_ = 0;
  float first_radius_ = 0;
  float shift_scale_ = 1;  ///< of distances to photons
  PilotLightWalks light_;
  VertexGrid grid_;
  PricingRecord record_;
};

}  // namespace

PricingRecord run_pricing_pilot(const Scene& scene, const PricingPlan& plan) {
  return PricingPilot(scene, plan).run();
}

}  // namespace duet
