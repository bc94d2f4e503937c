// Batches of paths from the camera.
#pragma once

#include "integrators/wide_stages.h"
#include "transport/counters.h"

namespace duet {

/// What the samples of a batch have gathered, by the numbers of their pixels.
struct WideSamples {
  BatchArray<float> r, g, b, alpha;

  void add(int id, const Spectrum& s) { r[id] += s.r, g[id] += s.g, b[id] += s.b; }
};

/// Whether the environment is to be seen: with hide_emitters not by paths that nothing has made
/// opaque yet.
inline bool sees_environment(const PathLimits& limits, int id, const WideSamples& samples) {
  return !limits.hide_emitters || samples.alpha[id] != 0;
}

/// Traces batches of paths from the camera for one thread; see WideTiles.
class WideWalk {
 public:
  virtual ~WideWalk() = default;

  /// Where paths begin: set by the caller, who fills ray, from, throughput, id and keys.
  virtual WidePaths& paths() = 0;
  /// Says which pixels (y · width + x of the full image) the next batches have, by their ids.
  virtual void enter(std::span<const uint64_t>) {}
  /// Traces the first `n` paths to their ends and adds what they find to `samples`.
  virtual void trace(int n, const BatchSampler& sampler, WideSamples& samples,
                     RenderCounters& counters) = 0;
};

}  // namespace duet
