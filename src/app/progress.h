// Shows how far a render has come.
#pragma once

#include <string>

#include "app/terminal_bar.h"
#include "base/log.h"
#include "evaluate/render/batch.h"
#include "integrators/pass.h"

namespace duet {

enum class ProgressStyle {
  automatic,  ///< a bar on a terminal, lines otherwise
  bar,
  plain,  ///< a line every few seconds
  none,
};

/// By its name; `automatic` for all others.
ProgressStyle progress_style(const std::string& name);

/// Draws the progress of one render on standard error.
class ProgressDisplay {
 public:
  /// `scene` is what the scene is called. The batch and the log must outlive this; messages that go
  /// there remove the bar.
  ProgressDisplay(ProgressStyle style, std::string scene, const Batch& batch, Log& log);

  void show(const RenderProgress& progress);

 private:
  std::string time_left(const RenderProgress& progress) const;
  std::string bar_line(const RenderProgress& progress) const;

  ProgressStyle style_;
  std::string scene_;
  const Batch& batch_;
  Log& log_;
  TerminalBar bar_;
  double last_line_ = 0;
};

}  // namespace duet
