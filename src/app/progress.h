// Shows how far a render has come.
#pragma once

#include <string>

#include "app/batch.h"
#include "base/log.h"
#include "integrators/pass.h"

namespace duet {

enum class ProgressStyle {
  automatic,  ///< a bar on a terminal, lines otherwise
  bar,
  plain,  ///< a line every few seconds
  none,
};

/// Draws the progress of one render on standard error.
class ProgressDisplay {
 public:
  /// `scene` is what the scene is called. The batch and the log must outlive this; messages that go
  /// there remove the bar.
  ProgressDisplay(ProgressStyle style, std::string scene, const Batch& batch, Log& log);
  ~ProgressDisplay();
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  void show(const RenderProgress& progress);

 private:
  void remove_bar();
  std::string time_left(const RenderProgress& progress) const;
  std::string bar(const RenderProgress& progress) const;

  ProgressStyle style_;
  std::string scene_;
  const Batch& batch_;
  Log& log_;
  bool bar_is_drawn_ = false;
  double last_line_ = 0;
};

}  // namespace duet
