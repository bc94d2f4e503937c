// Runs an integrator over a film: tiles, threads, seeds, budgets, cancellation.
#pragma once

#include <atomic>
#include <functional>
#include <optional>

#include "integrators/integrator.h"
#include "integrators/render_state.h"

namespace duet {

/// Independent sequences, each with a film of its own, from which the error is estimated when it
/// decides when to stop.
inline constexpr int kErrorBatches = 8;

/// When to stop; the first limit that is reached wins. At least one must be set.
struct RenderBudget {
  std::optional<int> spp;
  std::optional<double> seconds;  ///< including the choice of a method
  /// Relative root mean square error, estimated from independent batches.
  std::optional<double> target_error;
};

struct RenderProgress {
  double fraction = 0;                  ///< of the budget, as far as it is known
  double seconds = 0;                   ///< since the choice of a method began
  double spp = 0;                       ///< samples per pixel, those of tiles under way included
  double samples = 0;                   ///< samples taken in all pixels together
  std::optional<double> relative_rmse;  ///< estimate so far
};

struct RenderResult {
  Image image;
  RenderCounters counters;
  /// Samples that every pixel has, or has on average where noisy tiles got more. If it is zero
  /// there are pixels without any, and the image is empty.
  int spp = 0;
  double seconds = 0;        ///< including the choice of a method
  bool interrupted = false;  ///< cancelled before the samples were used up
  /// Estimate of the root mean square error over all pixels, relative to the mean of the image.
  std::optional<double> relative_rmse;
  /// True if the estimate comes from parts of one low-discrepancy sequence: they are more alike in
  /// what they leave out than independent batches, so the true error is smaller.
  bool rmse_is_upper_bound = false;
};

struct RenderRequest {
  RenderBudget budget;
  uint64_t seed = 0;
  SampleSequence sequence = SampleSequence::sobol;
  int threads = 1;
  /// How long a pass may last, if one sample per pixel does not last longer: after that an
  /// interrupt or a snapshot is answered, and what is there is a whole number of samples.
  double pass_seconds = 0.5;
  /// Take these samples instead of all those that the budget allows; without a limit of time or
  /// error only.
  std::optional<SampleInterval> samples;
  /// Whether an interrupt waits until every pixel has the sample that is under way: only then can
  /// the state be gone on from.
  bool keeps_state = false;
  /// Called a few times per second, from one thread at a time.
  std::function<void(const RenderProgress&)> progress;
  /// Set from outside to stop after the tiles that are under way. What they have is kept.
  const std::atomic<bool>* cancel = nullptr;
  /// Asked between passes, once every pixel has a sample: whether `snapshot` is to get the image so
  /// far. Rendering goes on afterwards.
  std::function<bool()> wants_snapshot;
  std::function<void(RenderResult)> snapshot;
  /// Called after each pass, if `keeps_state`.
  std::function<void(const RenderState&)> after_pass;
};

/// Renders until the budget is used up, pass by pass. The image depends on the
/// scene, the integrator, the film, the seed, the sequence and the number of samples; never on the
/// number of threads, nor on how the samples are divided into passes. Throws std::runtime_error if
/// the scene moves and another render of it is under way.
RenderResult render(const Scene& scene, Integrator& integrator, const FilmLayout& layout,
                    const RenderRequest& request);
/// The same, going on from `state`, which is that of another render of the same image with any
/// samples. It becomes that of this one. The image is the mean of all its samples.
RenderResult render(const Scene& scene, Integrator& integrator, const FilmLayout& layout,
                    const RenderRequest& request, RenderState& state);
/// What a state has come to, without taking more samples.
RenderResult develop(const RenderState& state, int threads = 1);

}  // namespace duet
