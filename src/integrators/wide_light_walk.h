// Many light sub-paths at once, stage by stage.
#pragma once

#include "base/object_pool.h"
#include "integrators/wide_light_kernels.h"
#include "integrators/wide_subpath_stages.h"
#include "transport/light_pass.h"
#include "transport/light_subpath.h"

namespace duet {

/// Traces light sub-paths of scenes without media for one thread, in the same way as LightPass
/// traces one: the same random numbers give the same vertices and, to rounding, the same of them
/// for the camera.
class WideLightWalk final : private WideSubpathStages {
 public:
  /// The scene must outlive this.
  explicit WideLightWalk(const WideScene& scene)
      : WideSubpathStages(scene, {}, Transport::importance) {}

  void trace(const LightPassPlan& plan, LightRange range, LightBlock& block);

 private:
  /// Begins the sub-paths of a range, at most kBatch; returns how many leave a light.
  int start(LightRange range, BatchSampler& sampler);
  void trace_batch(int n, const BatchSampler& sampler, LightBlock& block);
  int end_outside(int n);
  /// Makes Partials of the points, and PathVertex::light_sample.
  void arrive_at_points(int n, int depth);
  LightSampleVariance arrive_first(int i);
  /// Finds out how the lens sees the points.
  void look_at_lens(int n, const BatchSampler& sampler, uint32_t dimension);
  void connect_lens(int n, int depth, LightBlock& block);
  /// With hide_emitters the first shadow rays, which have been tested, are blocked by others alone.
  void see_past_emitters(int rays, RenderCounters& counters);
  void scatter(int n, const BatchSampler& sampler, uint32_t dimension, int depth);
  void keep_vertices(int n, int depth);
  LightVertex light_vertex(int i, int depth) const;
  ConnectionVertex connection_vertex(int i, int depth) const;
  /// Adds what was kept to the block, sub-path after sub-path.
  void append_kept(int subpaths, LightBlock& block);

  const LightPassPlan* plan_ = nullptr;  ///< of the trace() under way
  BatchKeys keys_{};
  BatchArray<uint64_t> pixel_keys_{};
  std::vector<std::optional<LightStart>> starts_;  ///< by id, the number in the batch
  std::vector<uint32_t> roulette_;                 ///< seeds of ConnectionRoulette, by id
  std::vector<int> lengths_;                       ///< vertices, by id
  /// TechniqueSet::pixel_group if an eye sub-path's second vertex would be shared at the last
  /// vertex of a sub-path, else 1; by id.
  std::vector<float> eye_paths_;
  WideSeen seen_{};
  /// Vertices of the batch in the order in which they were found, and their ids.
  std::vector<LightVertex> kept_;
  std::vector<ConnectionVertex> kept_connection_vertices_;
  std::vector<int32_t> kept_ids_;
  std::vector<uint32_t> places_;  ///< of the sub-paths' next vertices in the block, by id
};

/// The same for any number of threads.
class WideLightTracer final : public LightTracer {
 public:
  /// The scene must outlive this.
  explicit WideLightTracer(const WideScene& scene) : scene_(scene) {}

  void trace(const LightPassPlan& plan, LightRange range, LightBlock& block) override;

 private:
  const WideScene& scene_;
  ObjectPool<WideLightWalk> walks_;
};

}  // namespace duet
