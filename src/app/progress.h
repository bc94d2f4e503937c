// Shows how far a render has come.
#pragma once

#include <string>

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
  ProgressDisplay(ProgressStyle style, std::string scene);
  ~ProgressDisplay();
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  void show(const RenderProgress& progress);

 private:
  ProgressStyle style_;
  std::string scene_;
  double last_line_ = 0;
};

/// "1.2 s", "3 min 20 s", "2 h 5 min".
std::string format_seconds(double seconds);

}  // namespace duet
