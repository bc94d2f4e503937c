#include "integrators/pricing_pilot.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "integrators/learn_emission.h"
#include "integrators/pilot.h"
#include "integrators/pilot_eye_subpath.h"
#include "integrators/wide_scene.h"
#include "transport/light_subpath.h"

namespace duet {

namespace {

constexpr uint64_t kEyeSeed = 0x7072696365ull, kLightSeed = 0x6c69676874ull,
                   kLightShadowStream = 0x7368646full;
/// Longer paths add next to nothing to what the pilot is asked.
constexpr int kLongest = FamilyWeights::kMostVertices / 2;
constexpr size_t kSubpathsPerBlock = 64;

template <class Vertex>
class PricingPilot {
 public:
  PricingPilot(const Scene& scene, const PricingPlan& plan)
      : scene_(scene),
        plan_(plan),
        subpaths_(2 * size_t(plan.pixels_per_side) * plan.pixels_per_side),
        setup_{scene, plan} {
    setup_.max_depth = plan.max_depth < 0 ? kLongest : std::min(plan.max_depth, kLongest);
    setup_.options = {plan.rr_depth, plan.strict_normals};
    setup_.eye_seed = kEyeSeed ^ plan.seed;
    const double pixels = double(plan.film.x) * plan.film.y;
    TechniqueSet& set = setup_.set;
    set.hits = set.light_samples = set.camera_connections = set.connections = set.merges = true;
    set.light_paths = float(PricingRecord::kLightPaths * pixels);
    LightPassPlan light;
    light.set = set;
    light.subpath = setup_.options;
    light.max_depth = setup_.max_depth - 1;
    light.hide_emitters = plan.hide_emitters;
    light.seed = setup_.eye_seed;
    light.threads = plan.threads;
    setup_.guide = learn_emission(scene, plan.film, light);
    light.guide = setup_.guide.get();
    const Pilot sizes = run_pilot(scene, plan.film, light);
    const double radius = sizes.first_radius();
    set.merge_area = kPi * sqr(float(radius));
    setup_.threshold = sizes.roulette_threshold();
    // There are fewer sub-paths than an iteration has, of which an eye sub-path meets every second
    // one: with a larger radius the share of pairs is the one that is meant.
    const double thinned = double(subpaths_) / pixels;
    setup_.query_radius = float(radius * std::sqrt(2 * PricingRecord::kMergeShare / thinned));
    setup_.first_radius = float(radius);
    setup_.shift_scale = float(std::min(1.0, radius / double(setup_.query_radius)));
  }

  PricingRecord run() {
    record_.side = plan_.pixels_per_side;
    record_.seen.resize(subpaths_ / 2);
    trace_light();
    const PilotLightSubpaths& light = setup_.light;
    setup_.grid.build(
        uint32_t(light.vertices.size()),
        [&](uint32_t i) {
          const LightVertex& v = light.vertices[i];
          return v.merges ? v.position : VertexGrid::nowhere();
        },
        setup_.query_radius, plan_.threads);
    trace_eye();
    return std::move(record_);
  }

 private:
  struct Block {
    PricingRecord record;
    PilotLightSubpaths light;
  };

  uint16_t cell(const Point2f& film) const {
    const int side = plan_.pixels_per_side;
    const auto index = [&](float x, int size) {
      return std::clamp(int(double(x) / size * side), 0, side - 1);
    };
    return uint16_t(index(film.y, plan_.film.y) * side + index(film.x, plan_.film.x));
  }

  void trace_light() {
    std::vector<Block> blocks((subpaths_ + kSubpathsPerBlock - 1) / kSubpathsPerBlock);
    parallel_for(blocks.size(), plan_.threads, [&](size_t b) {
      const size_t end = std::min((b + 1) * kSubpathsPerBlock, subpaths_);
      for (size_t i = b * kSubpathsPerBlock; i < end; ++i) light_subpath(i, blocks[b]);
    });
    for (const Block& b : blocks) {
      setup_.light.append(b.light);
      record_.light_counters.add(b.record.light_counters);
      record_.light.insert(record_.light.end(), b.record.light.begin(), b.record.light.end());
    }
    record_.light_vertices = double(setup_.light.vertices.size());
  }

  void light_subpath(size_t index, Block& block) {
    const uint64_t seed = kLightSeed ^ plan_.seed, key = hash_combine(seed, index);
    Sampler sampler(SampleSequence::independent, seed, 0, index);
    sampler.start_sample(0);
    ConnectionRoulette roulette(setup_.threshold * setup_.set.light_paths, key);
    RandomStream random(key ^ kLightShadowStream);
    RenderCounters& counters = block.record.light_counters;
    SubpathPdfs pdfs;
    FamilyWeights weights(setup_.set);
    const LightStarts starts(scene_, setup_.guide.get());
    const ConnectionContext<FamilyWeights> connections{scene_,   starts, weights, roulette,
                                                       counters, false,  &random};
    const auto visit = [&](const Vertex& v, const Hit& hit) {
      if (!v.is_smooth()) return;
      block.light.add(v, hit, pdfs);
      weights.set_light(pdfs);
      const auto seen =
          connect_camera(connections, v, scene_.camera->has_lens() ? sampler.next_2d() : Point2f{},
                         plan_.hide_emitters);
      if (seen)
        add_contribution(
            block.record.light,
            seen->connection.value * (seen->connection.weight / setup_.set.light_paths),
            weights.shares(), Technique::light_image, cell(seen->film));
    };
    trace_light_subpath<Vertex>({scene_, starts, setup_.set, setup_.options, setup_.max_depth - 1,
                                 sampler, counters, &pdfs, ~key},
                                visit);
    block.light.end_subpath(pdfs);
  }

  void trace_eye() {
    std::vector<Block> blocks((subpaths_ + kSubpathsPerBlock - 1) / kSubpathsPerBlock);
    parallel_for(blocks.size(), plan_.threads, [&](size_t b) {
      const size_t end = std::min((b + 1) * kSubpathsPerBlock, subpaths_);
      PricingRecord& out = blocks[b].record;
      for (size_t i = b * kSubpathsPerBlock; i < end; ++i) {
        // No other block has the cell.
        trace_pilot_eye_subpath<Vertex>(setup_, i, out, record_.seen[i / 2]);
        out.ends.push_back(uint32_t(out.eye.size()));
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

  const Scene& scene_;
  PricingPlan plan_;
  size_t subpaths_;
  PilotSetup setup_;
  PricingRecord record_;
};

}  // namespace

PricingRecord run_pricing_pilot(const Scene& scene, const PricingPlan& plan) {
  if (scene.needs_media_vertices()) return PricingPilot<MediaVertex>(scene, plan).run();
  PricingRecord record = PricingPilot<PathVertex>(scene, plan).run();
  record.batches = suits_batches(scene);
  return record;
}

}  // namespace duet
