// All light sub-paths of an iteration: their vertices, and what the camera sees of them.
#pragma once

#include <algorithm>
#include <functional>

#include "image/film.h"
#include "transport/connection_vertex.h"
#include "transport/weights.h"
#include "transport/window_weights.h"

namespace duet {

struct LightBlock;
struct LightPassPlan;

/// Some of a pass's light sub-paths, by their numbers.
struct LightRange {
  uint32_t first, end;
};

/// Traces light sub-paths in another way than one by one, for a plan without windows: from any
/// thread.
class LightTracer {
 public:
  virtual ~LightTracer() = default;
  /// Adds what comes of them to an empty block.
  virtual void trace(const LightPassPlan& plan, LightRange range, LightBlock& block) = 0;
};

/// What a pass over the lights is to do.
struct LightPassPlan {
  const EmissionGuide* guide = nullptr;  ///< of the starts of sub-paths, or null
  TechniqueSet set;
  SubpathOptions subpath;
  int max_depth = 0;                 ///< segments of a light sub-path
  uint32_t first = 0, subpaths = 0;  ///< number of the first, and how many
  bool unit_weights = false;         ///< each path is made by one technique alone
  const Windows* windows = nullptr;  ///< if the sub-paths of the method are limited
  const MergeMask* mask = nullptr;   ///< if the set is partly merged
  bool hide_emitters = false;
  float roulette_threshold = 0;  ///< for what a sub-path adds to the film; see ConnectionRoulette
  bool keep_vertices = false;
  /// ConnectionVertex of each kept vertex as well; not where media are.
  bool keep_connection_vertices = false;
  SampleSequence sequence = SampleSequence::sobol;
  uint64_t seed = 0;
  uint32_t scramble = 0, iteration = 0;
  int threads = 1;
  LightTracer* tracer = nullptr;  ///< if they are not traced one by one

  /// Leaves the k-th of n parts of the sub-paths.
  void take_part(uint32_t k, uint32_t n);
  /// Of the sampler of sub-path i, for which i stands in the place of the pixel.
  uint64_t sampler_seed() const;
  /// Seeds what is decided about sub-path i beside its samples.
  uint64_t key(uint32_t i) const;
};

/// A splat with the number of light vertices of its technique.
struct LightSplat {
  Splat splat;
  float weight;
  int depth;
};

/// What comes of some of a pass's sub-paths.
struct LightBlock {
  LightVertices vertices;
  std::vector<ConnectionVertex> connection_vertices;
  SubpathPdfs pdf_lists;
  std::vector<uint32_t> pdf_ends;
  std::vector<EndPdfs> end_pdfs;
  std::vector<LightSplat> splats;
  RenderCounters counters;

  void clear();
  /// Ends a sub-path whose kept vertices end there, and that had so many with those that were not.
  void end_subpath(size_t end, int length) {
    vertices.ends.push_back(uint32_t(end));
    vertices.lengths.push_back(uint16_t(std::min(length, 0xffff)));
  }
};

/// Runs light passes; keeps its memory from one to the next.
class LightPass {
 public:
  /// Takes what the camera sees of many sub-paths; called from several threads at a time, in any
  /// order. The counters are its own.
  using TakeSplats = std::function<void(std::span<const LightSplat>, RenderCounters&)>;
  /// Traces the plan's sub-paths.
  void run(const Scene& scene, const LightPassPlan& plan, const TakeSplats& splats,
           RenderCounters& counters);

  const LightVertices& vertices() const { return vertices_; }
  /// One for each of the vertices, if the plan keeps them.
  const std::vector<ConnectionVertex>& connection_vertices() const { return connection_vertices_; }
  /// Vertex pdfs of a sub-path; if there are windows.
  std::span<const VertexPdfs> pdfs(size_t subpath) const {
    const uint32_t first = subpath == 0 ? 0 : pdf_ends_[subpath - 1];
    return {pdf_lists_.data() + first, pdf_ends_[subpath] - first};
  }
  /// What stood at the ends of that list at each of the sub-path's kept vertices; if there are
  /// windows and media, where a sub-path may pass surfaces straight.
  std::span<const EndPdfs> end_pdfs(size_t subpath) const {
    return vertices_.part_of(end_pdfs_, subpath);
  }
  /// Bytes that passes of such a plan take if each sub-path has so many vertices that can be
  /// connected.
  static double memory_bytes(const LightPassPlan& plan, int vertices_per_subpath);
  /// Makes room for the vertices of an average pass.
  void reserve(size_t vertices, size_t subpaths);

 private:
  template <class Vertex, class Weights>
  void trace(const Scene& scene, const LightPassPlan& plan, const Weights& weights,
             LightRange range, SubpathPdfs* pdfs, LightBlock& block) const;
  template <class Vertex>
  void trace(const Scene& scene, const LightPassPlan& plan, LightRange range,
             LightBlock& block) const;

  /// Adds the results of the first blocks to those of the pass, in their order.
  void append_blocks(const LightPassPlan& plan, uint32_t count);

  std::vector<LightBlock> blocks_;
  size_t kept_ = 0;  ///< vertices of the pass so far
  LightVertices vertices_;
  std::vector<ConnectionVertex> connection_vertices_;
  SubpathPdfs pdf_lists_;
  std::vector<uint32_t> pdf_ends_;
  std::vector<EndPdfs> end_pdfs_;
};

}  // namespace duet
