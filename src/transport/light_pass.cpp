#include "transport/light_pass.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"
#include "math/batch.h"
#include "transport/light_subpath.h"

namespace duet {

namespace {

/// Sub-paths that one task traces, and tasks whose results are held at a time: some for every
/// thread, since they do not all take as long.
constexpr uint32_t kFewestPerBlock = 64, kSubpathsPerBlock = 1024;
constexpr uint32_t kFewestBlocks = 16, kTasksPerThread = 4;

uint32_t blocks_at_a_time(int threads) {
  return std::max(kFewestBlocks, kTasksPerThread * uint32_t(std::max(1, threads)));
}

/// Sub-paths of a block: fewer where there would not be enough blocks for all threads. Batches have
/// the same sub-paths whatever the number of threads: what a packet of rays finds may depend on all
/// of them where surfaces are equally near.
uint32_t block_size(const LightPassPlan& plan) {
  const uint32_t tasks = kTasksPerThread * uint32_t(std::max(1, plan.threads));
  const uint32_t size = std::clamp(plan.subpaths / tasks, kFewestPerBlock, kSubpathsPerBlock);
  return plan.tracer ? (size + kBatch - 1) / kBatch * kBatch : size;
}

/// Makes room for the blocks' parts of a list, from entry `end` on; returns where each begins.
/// Entries that are there already are not made anew, which one thread would have to do.
template <class T, class Part>
std::vector<size_t> make_room(std::vector<T>& list, size_t end, uint32_t blocks, const Part& part) {
  std::vector<size_t> begins;
  for (uint32_t i = 0; i < blocks; ++i) begins.push_back(std::exchange(end, end + part(i).size()));
  if (end > list.size()) list.resize(end);
  return begins;
}

/// Keeps the random numbers of light sub-paths apart from those of the pixels.
constexpr uint64_t kLightStream = 0x6c69676874ull;
/// The same for what happens in media, on sub-paths and on their shadow rays.
constexpr uint64_t kMediaStream = 0x6d65646961ull;

}  // namespace

uint64_t LightPassPlan::sampler_seed() const {
  return seed ^ kLightStream;
}

void LightPassPlan::take_part(uint32_t k, uint32_t n) {
  const auto begin = [&](uint64_t i) { return uint32_t(subpaths * i / n); };
  const uint32_t end = begin(k + 1);
  first = begin(k);
  subpaths = end - first;
}

uint64_t LightPassPlan::key(uint32_t i) const {
  return hash_combine(hash_combine(seed, scramble ^ kLightStream), (uint64_t(iteration) << 32) + i);
}

void LightBlock::clear() {
  vertices.clear();
  connection_vertices.clear();
  pdf_lists.clear();
  pdf_ends.clear();
  end_pdfs.clear();
  splats.clear();
  counters = {};
}

double LightPass::memory_bytes(const LightPassPlan& plan, int vertices_per_subpath) {
  // Arrays that grow by doubling may hold twice as much as they need to.
  constexpr double kGrowth = 2;
  const double vertices = vertices_per_subpath;
  const double pdfs =
      plan.windows
          ? kGrowth * ((vertices + 2) * sizeof(VertexPdfs) + 4 + vertices * sizeof(EndPdfs))
          : 0.0;
  const double for_connections = plan.keep_connection_vertices ? sizeof(ConnectionVertex) : 0.0;
  const double kept =
      plan.keep_vertices ? vertices * (sizeof(LightVertex) + for_connections) + 6 : 0.0;
  const double at_a_time =
      std::min(double(plan.subpaths), double(kSubpathsPerBlock) * blocks_at_a_time(plan.threads));
  return double(plan.subpaths) * (kept + pdfs) +
         at_a_time * kGrowth *
             (vertices * (sizeof(LightVertex) + for_connections + sizeof(LightSplat)) + pdfs);
}

void LightPass::reserve(size_t vertices, size_t subpaths) {
  vertices_.vertices.reserve(vertices);
  vertices_.ends.reserve(subpaths);
  vertices_.lengths.reserve(subpaths);
}

template <class Vertex, class Weights>
void LightPass::trace(const Scene& scene, const LightPassPlan& plan, const Weights& weights,
                      LightRange range, SubpathPdfs* pdfs, LightBlock& block) const {
  const bool has_lens = scene.camera->has_lens();
  const LightStarts starts(scene, plan.guide);
  for (uint32_t i = range.first; i < range.end; ++i) {
    const uint64_t key = plan.key(i);
    ConnectionRoulette roulette(plan.roulette_threshold, key);
    RandomStream random(key ^ kMediaStream);
    Sampler sampler(plan.sequence, plan.sampler_seed(), plan.scramble, i);
    sampler.start_sample(plan.iteration);
    const ConnectionContext<Weights> connections{scene,          starts, weights, roulette,
                                                 block.counters, false,  &random};
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
        if constexpr (!Vertex::kMedia)
          if (plan.keep_connection_vertices) block.connection_vertices.emplace_back(v);
        if (Vertex::kMedia && pdfs) block.end_pdfs.push_back({pdfs->front(), pdfs->back()});
      }
    };
    const int length =
        trace_light_subpath<Vertex>({scene, starts, plan.set, plan.subpath, plan.max_depth, sampler,
                                     block.counters, pdfs, ~key ^ kMediaStream},
                                    visit);
    block.end_subpath(block.vertices.vertices.size(), length);
    if (pdfs) {
      block.pdf_lists.insert(block.pdf_lists.end(), pdfs->begin(), pdfs->end());
      block.pdf_ends.push_back(uint32_t(block.pdf_lists.size()));
    }
  }
}

template <class Vertex>
void LightPass::trace(const Scene& scene, const LightPassPlan& plan, LightRange range,
                      LightBlock& block) const {
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

void LightPass::append_blocks(const LightPassPlan& plan, uint32_t count) {
  const auto append_at = [&](size_t end, auto& list, const auto& part, const auto& changed) {
    const std::vector<size_t> begins = make_room(list, end, count, part);
    parallel_for(count, plan.threads, [&](size_t i) {
      std::transform(part(uint32_t(i)).begin(), part(uint32_t(i)).end(),
                     list.begin() + ptrdiff_t(begins[i]),
                     [&](const auto& value) { return changed(value, i); });
    });
    return begins;
  };
  const auto append = [&](auto& list, const auto& part, const auto& changed) {
    return append_at(list.size(), list, part, changed);
  };
  const auto same = [](const auto& value, size_t) { return value; };
  const auto& blocks = blocks_;
  if (plan.keep_vertices) {
    const auto begins = append_at(
        kept_, vertices_.vertices, [&](uint32_t i) -> auto& { return blocks[i].vertices.vertices; },
        same);
    append(
        vertices_.ends, [&](uint32_t i) -> auto& { return blocks[i].vertices.ends; },
        [&](uint32_t end, size_t i) { return uint32_t(begins[i]) + end; });
    append(
        vertices_.lengths, [&](uint32_t i) -> auto& { return blocks[i].vertices.lengths; }, same);
    if (plan.keep_connection_vertices)
      append_at(
          kept_,
          connection_vertices_, [&](uint32_t i) -> auto& { return blocks[i].connection_vertices; },
          same);
    kept_ = begins.back() + blocks[count - 1].vertices.vertices.size();
  }
  if (!plan.windows) return;
  const auto begins = append(
      pdf_lists_, [&](uint32_t i) -> auto& { return blocks[i].pdf_lists; }, same);
  append(
      pdf_ends_, [&](uint32_t i) -> auto& { return blocks[i].pdf_ends; },
      [&](uint32_t end, size_t i) { return uint32_t(begins[i]) + end; });
  append(
      end_pdfs_, [&](uint32_t i) -> auto& { return blocks[i].end_pdfs; }, same);
}

void LightPass::run(const Scene& scene, const LightPassPlan& plan, const TakeSplats& splats,
                    RenderCounters& counters) {
  kept_ = 0;
  vertices_.ends.clear();
  vertices_.lengths.clear();
  pdf_lists_.clear();
  pdf_ends_.clear();
  end_pdfs_.clear();
  const uint32_t at_a_time = blocks_at_a_time(plan.threads), size = block_size(plan);
  blocks_.resize(at_a_time);
  for (uint32_t wave = 0; wave < plan.subpaths; wave += size * at_a_time) {
    const uint32_t left = (plan.subpaths - wave + size - 1) / size;
    const uint32_t count = std::min(left, at_a_time);
    parallel_for(count, plan.threads, [&](size_t i) {
      const uint32_t begin = wave + uint32_t(i) * size;
      const uint32_t first = plan.first + begin;
      const uint32_t end = plan.first + std::min(begin + size, plan.subpaths);
      LightBlock& block = blocks_[i];
      block.clear();
      if (plan.tracer)
        plan.tracer->trace(plan, {first, end}, block);
      else if (scene.needs_media_vertices())
        trace<MediaVertex>(scene, plan, {first, end}, block);
      else
        trace<PathVertex>(scene, plan, {first, end}, block);
      if (!block.splats.empty()) splats(block.splats, block.counters);
    });
    for (uint32_t i = 0; i < count; ++i) counters.add(blocks_[i].counters);
    append_blocks(plan, count);
  }
  vertices_.vertices.resize(kept_);
  connection_vertices_.resize(plan.keep_connection_vertices ? kept_ : 0);
}

}  // namespace duet
