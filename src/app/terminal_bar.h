// A line on standard error that stands below the messages and changes.
#pragma once

#include <string>

#include "base/log.h"

namespace duet {

class TerminalBar {
 public:
  /// Messages that go to the log, which must outlive this, remove the bar.
  explicit TerminalBar(Log& log);
  ~TerminalBar();
  TerminalBar(const TerminalBar&) = delete;
  TerminalBar& operator=(const TerminalBar&) = delete;

  /// Columns that there are for it.
  static size_t width();
  /// Shows this in the place of what there is. What is too long is cut off.
  void draw(const std::string& line);

 private:
  void remove();

  Log& log_;
  bool is_drawn_ = false;
};

}  // namespace duet
