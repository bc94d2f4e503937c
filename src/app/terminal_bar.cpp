#include "app/terminal_bar.h"

#include <cstdio>

#include "base/system/standard_streams.h"
#include "base/terminal.h"

namespace duet {

TerminalBar::TerminalBar(Log& log) : log_(log) {
  log_.set_before_write([this] { remove(); });
}

TerminalBar::~TerminalBar() {
  log_.set_before_write(nullptr);
  remove();
}

size_t TerminalBar::width() {
  return terminal_width(StandardStream::error) - 1;
}

void TerminalBar::draw(const std::string& line) {
  const std::string shown = columns(line) > width() ? line.substr(0, width()) : line;
  std::fprintf(stderr, "\r\x1b[K%s", shown.c_str());
  std::fflush(stderr);
  is_drawn_ = true;
}

void TerminalBar::remove() {
  if (!is_drawn_) return;
  std::fputs("\r\x1b[K", stderr);
  is_drawn_ = false;
}

}  // namespace duet
