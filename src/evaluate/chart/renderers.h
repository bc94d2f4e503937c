// The methods that `duet chart` compares: each renders in slices, so that they can take turns.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "evaluate/chart/data.h"
#include "image/reference_error.h"
#include "integrators/make_integrator.h"
#include "integrators/pass.h"

namespace duet {

/// One that takes turns with others.
class ChartRenderer {
 public:
  ChartRenderer(const NoisyReference& reference, double budget)
      : reference_(reference), budget_(budget) {}
  virtual ~ChartRenderer() = default;
  ChartRenderer(const ChartRenderer&) = delete;
  ChartRenderer& operator=(const ChartRenderer&) = delete;

  /// Renders for about this many seconds, and records a point where one is due.
  virtual void slice(double seconds) = 0;
  /// Wall-clock seconds used so far, of all runs.
  virtual double used() const = 0;
  virtual bool finished() const = 0;
  /// Called once, when there is no more time: records what the last slices have brought.
  virtual void finish() {}

  ChartLine line;

 protected:
  /// Adds a point; the image is kept if it is the last.
  void record(double seconds, double cpu_seconds, int spp, Image image);

  const NoisyReference& reference_;
  const double budget_;  ///< seconds
};

/// How all of Duet's own methods render.
struct ChartRender {
  const Scene* scene = nullptr;
  FilmLayout layout;
  uint64_t seed = 0;
  int threads = 1;
  const std::atomic<bool>* cancel = nullptr;
};

/// A method of Duet, rendering one image whose samples grow in number.
class OwnRenderer : public ChartRenderer {
 public:
  OwnRenderer(const ChartRender& render, std::unique_ptr<Integrator> integrator,
              const NoisyReference& reference, double budget);
  void slice(double seconds) override;
  double used() const override { return seconds_; }
  bool finished() const override;
  void finish() override;

 private:
  void add_point();
  const ChartRender& render_;
  std::unique_ptr<Integrator> integrator_;
  Film film_;
  RenderCounters counters_;
  int spp_ = 0, recorded_spp_ = 0;
  double seconds_ = 0, cpu_seconds_ = 0;
  double next_point_ = 0;  ///< seconds at which one is due
};

/// One run of another program.
struct ExternalRun {
  std::string scene;   ///< file
  std::string output;  ///< the file that the program writes
  uint64_t seed = 0;
  int spp = 1;
  int width = 0, height = 0;
};
/// The command of a run, for the shell.
using ExternalCommand = std::function<std::string(const ExternalRun&)>;
/// Fills in {spp} {out} {scene} {seed} {width} {height}. It throws UsageError for other
/// placeholders.
ExternalCommand external_command(const std::string& pattern);

/// Another program, started anew for 1, 2, 4, … samples per pixel and timed as a whole.
class ExternalRenderer : public ChartRenderer {
 public:
  struct Task {
    ExternalCommand command;
    ExternalRun run;  ///< the first; its output is removed again
    const std::atomic<bool>* cancel = nullptr;
  };
  ExternalRenderer(Task task, const NoisyReference& reference, double budget)
      : ChartRenderer(reference, budget), task_(std::move(task)) {
    line.external = true;
  }
  /// One whole run, whatever it takes; it is stopped when the time of this renderer is up.
  void slice(double seconds) override;
  double used() const override { return used_; }
  bool finished() const override;

 private:
  void fail(const std::string& why);
  Task task_;
  double used_ = 0, last_ = 0;
};

}  // namespace duet
