// Runs an integrator over a film: tiles, threads, seeds, budgets, cancellation.
#pragma once

#include <atomic>
#include <functional>
#include <optional>

#include "integrators/integrator.h"

namespace duet {

/// When to stop; the first limit that is reached wins. Without any, the scene's sample count.
struct RenderBudget {
  std::optional<int> spp;
  std::optional<double> seconds;
  /// Estimated root mean square error relative to the image's mean.
  std::optional<double> target_error;
};

struct RenderProgress {
  double fraction = 0;  ///< of the budget
  double seconds = 0;   ///< since rendering began
  int spp = 0;          ///< completed samples per pixel
  uint64_t paths = 0;
  std::optional<double> relative_rmse;  ///< estimate so far
};

struct RenderRequest {
  RenderBudget budget;
  uint64_t seed = 0;
  SampleSequence sequence = SampleSequence::sobol;
  int threads = 1;
  /// Called between passes and a few times per second within them, from one thread at a time.
  std::function<void(const RenderProgress&)> progress;
  /// Set from outside to stop at the next tile boundary of a pass; the pass is then not used.
  const std::atomic<bool>* cancel = nullptr;
};

struct RenderResult {
  Image image;
  RenderCounters counters;
  int spp = 0;
  double seconds = 0;
  bool interrupted = false;
  /// Estimated relative RMSE of the image and whether it is an estimate from independent batches or
  /// (for a single low-discrepancy sequence) an upper bound.
  std::optional<double> relative_rmse;
  bool rmse_is_upper_bound = false;
};

RenderResult render(const Scene& scene, const Integrator& integrator, Film& film,
                    const RenderRequest& request);

}  // namespace duet
