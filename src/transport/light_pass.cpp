#include "transport/light_pass.h"

#include <algorithm>

#include "base/parallel.h"
#include "transport/light_walk.h"

namespace duet {

namespace {

/// Walks that one task traces, and tasks whose results are held at a time.
constexpr uint32_t kWalksPerBlock = 1024;
constexpr uint32_t kBlocksAtATime = 16;
/// Keeps the random numbers of light walks apart from those of the pixels.
constexpr uint64_t kLightStream = 0x6c69676874ull;
/// The same for what happens in media, on walks and on their shadow rays.
constexpr uint64_t kMediaStream = 0x6d65646961ull;

}  // namespace

double LightPass::memory_bytes(const LightPassPlan& plan, int vertices_per_walk) {
  // Arrays that grow by doubling may hold twice as much as they need to.
  constexpr double kGrowth = 2;
  const double vertices = vertices_per_walk;
  const double trail = plan.windows ? kGrowth * ((vertices + 2) * sizeof(TrailVertex) + 4) : 0.0;
  const double kept = plan.keep_vertices ? vertices * sizeof(LightVertex) + 6 : 0.0;
  const double at_a_time = std::min(double(plan.walks), double(kWalksPerBlock * kBlocksAtATime));
  return double(plan.walks) * (kept + trail) +
         at_a_time * kGrowth * (vertices * (sizeof(LightVertex) + sizeof(LightSplat)) + trail);
}

void LightPass::reserve(size_t vertices, size_t walks) {
  vertices_.vertices.reserve(vertices);
  vertices_.ends.reserve(walks);
  vertices_.lengths.reserve(walks);
}

template <class Vertex, class Weights>
void LightPass::trace(const Scene& scene, const LightPassPlan& plan, const Weights& weights,
                      Range range, Trail* trail, Block& block) const {
  block.vertices.clear();
  block.splats.clear();
  block.trails.clear();
  block.trail_ends.clear();
  block.counters = {};
  const bool has_lens = scene.camera->has_lens();
  for (uint32_t i = range.first; i < range.end; ++i) {
    const uint64_t key = hash_combine(hash_combine(plan.seed, plan.scramble ^ kLightStream),
                                      (uint64_t(plan.iteration) << 32) + i);
    JoinRoulette roulette(plan.roulette_threshold, key);
    RandomStream random(key ^ kMediaStream);
    Sampler sampler(plan.sequence, plan.seed ^ kLightStream, plan.scramble, i);
    sampler.start_sample(plan.iteration);
    const JoinContext<Weights> joins{scene, weights, roulette, block.counters, false, &random};
    const auto visit = [&](const Vertex& v, const Hit& hit) {
      if (!v.is_smooth()) return;
      if (plan.set.camera_joins) {
        const Point2f lens = has_lens ? sampler.next_2d() : Point2f{};
        const auto seen = join_camera(joins, v, lens, plan.hide_emitters);
        if (seen)
          block.splats.push_back({{seen->film, seen->join.value}, seen->join.weight, v.depth});
      }
      if (plan.keep_vertices && (plan.set.connections || v.merges()))
        block.vertices.vertices.emplace_back(v, hit);
    };
    const int length =
        trace_light_walk<Vertex>({scene, plan.set, plan.walk, plan.max_depth, sampler,
                                  block.counters, trail, ~key ^ kMediaStream},
                                 visit);
    block.vertices.ends.push_back(uint32_t(block.vertices.vertices.size()));
    block.vertices.lengths.push_back(uint16_t(std::min(length, 0xffff)));
    if (trail) {
      block.trails.insert(block.trails.end(), trail->begin(), trail->end());
      block.trail_ends.push_back(uint32_t(block.trails.size()));
    }
  }
}

template <class Vertex>
void LightPass::trace(const Scene& scene, const LightPassPlan& plan, Range range,
                      Block& block) const {
  if (plan.windows) {
    Trail trail;
    trace<Vertex>(scene, plan, WindowWeights(*plan.windows, &trail, nullptr), range, &trail, block);
  } else if (plan.unit_weights) {
    trace<Vertex>(scene, plan, UnitWeights(), range, nullptr, block);
  } else if (plan.set.partly_merged) {
    trace<Vertex>(scene, plan, MaskedWeights(plan.set, *plan.mask), range, nullptr, block);
  } else {
    trace<Vertex>(scene, plan, BalanceWeights(plan.set), range, nullptr, block);
  }
}

void LightPass::run(const Scene& scene, const LightPassPlan& plan,
                    const std::function<void(std::span<const LightSplat>)>& splats,
                    RenderCounters& counters) {
  vertices_.clear();
  trails_.clear();
  trail_ends_.clear();
  blocks_.resize(kBlocksAtATime);
  for (uint32_t wave = 0; wave < plan.walks; wave += kWalksPerBlock * kBlocksAtATime) {
    const uint32_t left = (plan.walks - wave + kWalksPerBlock - 1) / kWalksPerBlock;
    const uint32_t count = std::min(left, kBlocksAtATime);
    parallel_for(count, plan.threads, [&](size_t i) {
      const uint32_t first = wave + uint32_t(i) * kWalksPerBlock;
      const uint32_t end = std::min(first + kWalksPerBlock, plan.walks);
      if (scene.media.empty())
        trace<PathVertex>(scene, plan, {first, end}, blocks_[i]);
      else
        trace<MediaVertex>(scene, plan, {first, end}, blocks_[i]);
    });
    for (uint32_t i = 0; i < count; ++i) {
      const Block& b = blocks_[i];
      counters.add(b.counters);
      if (!b.splats.empty()) splats(b.splats);
      if (plan.keep_vertices) vertices_.append(b.vertices);
      if (!plan.windows) continue;
      const uint32_t offset = uint32_t(trails_.size());
      trails_.insert(trails_.end(), b.trails.begin(), b.trails.end());
      for (const uint32_t e : b.trail_ends) trail_ends_.push_back(offset + e);
    }
  }
}

}  // namespace duet
