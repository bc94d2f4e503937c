// All light walks of an iteration: their vertices, and what the camera sees of them.
#pragma once

#include <functional>

#include "image/film.h"
#include "transport/weights.h"
#include "transport/window_weights.h"

namespace duet {

/// What a pass over the lights is to do.
struct LightPassPlan {
  TechniqueSet set;
  WalkOptions walk;
  int max_depth = 0;  ///< segments of a light walk
  uint32_t walks = 0;
  bool unit_weights = false;         ///< each path is made by one technique alone
  const Windows* windows = nullptr;  ///< if the walks of the method are limited
  const MergeMask* mask = nullptr;   ///< if the set is partly merged
  bool hide_emitters = false;
  float roulette_threshold = 0;  ///< for what a walk adds to the film; see JoinRoulette
  bool keep_vertices = false;
  SampleSequence sequence = SampleSequence::sobol;
  uint64_t seed = 0;
  uint32_t scramble = 0, iteration = 0;
  int threads = 1;
};

/// A splat with the number of light vertices of its technique.
struct LightSplat {
  Splat splat;
  float weight;
  int depth;
};

/// Runs light passes; keeps its memory from one to the next.
class LightPass {
 public:
  /// Traces the plan's walks. `splats` takes what the camera sees, many at a time and always in the
  /// same order, whatever the number of threads.
  void run(const Scene& scene, const LightPassPlan& plan,
           const std::function<void(std::span<const LightSplat>)>& splats,
           RenderCounters& counters);

  const LightVertices& vertices() const { return vertices_; }
  /// Trails of the walks, one after the other, as `trail_ends` says; if there are windows.
  std::span<const TrailVertex> trail(size_t walk) const {
    const uint32_t first = walk == 0 ? 0 : trail_ends_[walk - 1];
    return {trails_.data() + first, trail_ends_[walk] - first};
  }
  /// Bytes that passes of such a plan take if each walk has so many vertices that can be connected.
  static double memory_bytes(const LightPassPlan& plan, int vertices_per_walk);
  /// Makes room for the vertices of an average pass.
  void reserve(size_t vertices, size_t walks);

 private:
  struct Block {
    LightVertices vertices;
    Trail trails;
    std::vector<uint32_t> trail_ends;
    std::vector<LightSplat> splats;
    RenderCounters counters;
  };
  struct Range {
    uint32_t first, end;  ///< of the walks
  };
  template <class Vertex, class Weights>
  void trace(const Scene& scene, const LightPassPlan& plan, const Weights& weights, Range range,
             Trail* trail, Block& block) const;
  template <class Vertex>
  void trace(const Scene& scene, const LightPassPlan& plan, Range range, Block& block) const;

  std::vector<Block> blocks_;
  LightVertices vertices_;
  Trail trails_;
  std::vector<uint32_t> trail_ends_;
};

}  // namespace duet
