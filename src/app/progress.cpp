#include "app/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/log.h"

namespace duet {

namespace {

constexpr double kSecondsBetweenLines = 5;
bool bar_is_drawn = false;

void remove_bar() {
  if (!bar_is_drawn) return;
  std::fputs("\r\x1b[K", stderr);
  bar_is_drawn = false;
}

int terminal_width() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

std::string describe(const RenderProgress& p) {
  // What is shown is there: rounded down.
  const double spp = p.spp < 10 ? std::floor(10 * p.spp) / 10 : std::floor(p.spp);
  std::string text = fmt::format("{} spp, {}", spp, format_seconds(p.seconds));
  if (p.seconds > 0) text += fmt::format(", {:.2f} Msamples/s", p.samples / p.seconds * 1e-6);
  if (p.relative_rmse) text += fmt::format(", error {:.2g} %", 100 * *p.relative_rmse);
  if (p.fraction > 0.001)
    text += fmt::format(", {} left", format_seconds(p.seconds * (1 / p.fraction - 1)));
  return text;
}

}  // namespace

std::string format_seconds(double s) {
  if (s < 60) return fmt::format("{:.1f} s", s);
  const long t = long(s + 0.5);
  if (t < 3600) return fmt::format("{} min {} s", t / 60, t % 60);
  return fmt::format("{} h {} min", t / 3600, t % 3600 / 60);
}

ProgressDisplay::ProgressDisplay(ProgressStyle style, std::string scene)
    : style_(style), scene_(std::move(scene)) {
  if (style_ == ProgressStyle::automatic)
    style_ = isatty(STDERR_FILENO) ? ProgressStyle::bar : ProgressStyle::plain;
  log::set_before_write(remove_bar);
}

ProgressDisplay::~ProgressDisplay() {
  remove_bar();
}

void ProgressDisplay::show(const RenderProgress& p) {
  const double fraction = std::clamp(p.fraction, 0.0, 1.0);
  if (style_ == ProgressStyle::plain && p.seconds - last_line_ >= kSecondsBetweenLines) {
    last_line_ = p.seconds;
    log::info("{}: {:.0f} %, {}", scene_, 100 * fraction, describe(p));
  }
  if (style_ != ProgressStyle::bar || log::level() == log::Level::quiet) return;
  constexpr int kBarWidth = 24;
  const int filled = int(fraction * kBarWidth);
  std::string line = fmt::format("[{}{}] {:3.0f} % {}", std::string(filled, '#'),
                                 std::string(kBarWidth - filled, '.'), 100 * fraction, describe(p));
  const size_t width = size_t(terminal_width());
  if (line.size() >= width) line.resize(width - 1);
  std::fprintf(stderr, "\r\x1b[K%s", line.c_str());
  std::fflush(stderr);
  bar_is_drawn = true;
}

}  // namespace duet
