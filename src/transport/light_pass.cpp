#include "transport/light_pass.h"

#include <algorithm>

#include "base/parallel.h"
#include "transport/light_subpath.h"

namespace duet {

namespace {

/// Sub-paths that one task traces, and tasks whose results are held at a time.
constexpr uint32_t kSubpathsPerBlock = 1024;
constexpr uint32_t kBlocksAtATime = 16;
/// Keeps the random numbers of light sub-paths apart from those of the pixels.
constexpr uint64_t kLightStream = 0x6c69676874ull;
/// The same for what happens in media, on sub-paths and on their shadow rays.
constexpr uint64_t kMediaStream = 0x6d65646961ull;

}  // namespace

double LightPass::memory_bytes(const LightPassPlan& plan, int vertices_per_subpath) {
  // Arrays that grow by doubling may hold twice as much as they need to.
  constexpr double kGrowth = 2;
  const double vertices = vertices_per_subpath;
  const double pdfs =
      plan.windows
          ? kGrowth * ((vertices + 2) * sizeof(VertexPdfs) + 4 + vertices * sizeof(EndPdfs))
          : 0.0;
  const double kept = plan.keep_vertices ? vertices * sizeof(LightVertex) + 6 : 0.0;
  const double at_a_time =
      std::min(double(plan.subpaths), double(kSubpathsPerBlock * kBlocksAtATime));
  return double(plan.subpaths) * (kept + pdfs) +
         at_a_time * kGrowth * (vertices * (sizeof(LightVertex) + sizeof(LightSplat)) + pdfs);
}

void LightPass::reserve(size_t vertices, size_t subpaths) {
  vertices_.vertices.reserve(vertices);
  vertices_.ends.reserve(subpaths);
  vertices_.lengths.reserve(subpaths);
}

template <class Vertex, class Weights>
void LightPass::trace(const Scene& scene, const LightPassPlan& plan, const Weights& weights,
                      Range range, SubpathPdfs* pdfs, Block& block) const {
  block.vertices.clear();
  block.splats.clear();
  block.pdf_lists.clear();
  block.pdf_ends.clear();
  block.end_pdfs.clear();
  block.counters = {};
  const bool has_lens = scene.camera->has_lens();
  for (uint32_t i = range.first; i < range.end; ++i) {
    const uint64_t key = hash_combine(hash_combine(plan.seed, plan.scramble ^ kLightStream),
                                      (uint64_t(plan.iteration) << 32) + i);
    ConnectionRoulette roulette(plan.roulette_threshold, key);
    RandomStream random(key ^ kMediaStream);
    Sampler sampler(plan.sequence, plan.seed ^ kLightStream, plan.scramble, i);
    sampler.start_sample(plan.iteration);
    const ConnectionContext<Weights> connections{scene,          weights, roulette,
                                                 block.counters, false,   &random};
    const auto visit = [&](const Vertex& v, const Hit& hit) {
      if (!v.is_smooth()) return;
      if (plan.set.camera_connections) {
        const Point2f lens = has_lens ? sampler.next_2d() : Point2f{};
        const auto seen = connect_camera(connections, v, lens, plan.hide_emitters);
        if (seen)
          block.splats.push_back(
              {{seen->film, seen->connection.value}, seen->connection.weight, v.depth});
      }
      if (plan.keep_vertices && (plan.set.connections || v.merges())) {
        block.vertices.vertices.emplace_back(v, hit);
        if (Vertex::kMedia && pdfs) block.end_pdfs.push_back({pdfs->front(), pdfs->back()});
      }
    };
    const int length =
        trace_light_subpath<Vertex>({scene, plan.set, plan.subpath, plan.max_depth, sampler,
                                     block.counters, pdfs, ~key ^ kMediaStream},
                                    visit);
    block.vertices.ends.push_back(uint32_t(block.vertices.vertices.size()));
    block.vertices.lengths.push_back(uint16_t(std::min(length, 0xffff)));
    if (pdfs) {
      block.pdf_lists.insert(block.pdf_lists.end(), pdfs->begin(), pdfs->end());
      block.pdf_ends.push_back(uint32_t(block.pdf_lists.size()));
    }
  }
}

template <class Vertex>
void LightPass::trace(const Scene& scene, const LightPassPlan& plan, Range range,
                      Block& block) const {
  if (plan.windows) {
    SubpathPdfs pdfs;
    trace<Vertex>(scene, plan, WindowWeights(*plan.windows, &pdfs, nullptr), range, &pdfs, block);
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
  pdf_lists_.clear();
  pdf_ends_.clear();
  end_pdfs_.clear();
  blocks_.resize(kBlocksAtATime);
  for (uint32_t wave = 0; wave < plan.subpaths; wave += kSubpathsPerBlock * kBlocksAtATime) {
    const uint32_t left = (plan.subpaths - wave + kSubpathsPerBlock - 1) / kSubpathsPerBlock;
    const uint32_t count = std::min(left, kBlocksAtATime);
    parallel_for(count, plan.threads, [&](size_t i) {
      const uint32_t first = wave + uint32_t(i) * kSubpathsPerBlock;
      const uint32_t end = std::min(first + kSubpathsPerBlock, plan.subpaths);
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
      const uint32_t offset = uint32_t(pdf_lists_.size());
      pdf_lists_.insert(pdf_lists_.end(), b.pdf_lists.begin(), b.pdf_lists.end());
      for (const uint32_t e : b.pdf_ends) pdf_ends_.push_back(offset + e);
      end_pdfs_.insert(end_pdfs_.end(), b.end_pdfs.begin(), b.end_pdfs.end());
    }
  }
}

}  // namespace duet
