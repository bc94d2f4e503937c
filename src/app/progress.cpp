#include "app/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "base/percent.h"
#include "base/seconds_text.h"
#include "base/system/standard_streams.h"
#include "base/terminal.h"

namespace duet {

namespace {

constexpr double kSecondsBetweenLines = 5;

std::string rate(const RenderProgress& p) {
  return p.seconds > 0 ? fmt::format("{:.2f} Msamples/s", p.samples / p.seconds * 1e-6) : "";
}

std::string samples(const RenderProgress& p) {
  // What is shown is there: rounded down.
  return fmt::format("{} spp", p.spp < 10 ? std::floor(10 * p.spp) / 10 : std::floor(p.spp));
}

std::string error(const RenderProgress& p) {
  return p.relative_rmse ? "error " + percent(*p.relative_rmse) : "";
}

/// Those that say something, with commas between them.
std::string listed(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() || part.empty() ? "" : ", ") + part;
  return text;
}

double fraction_of(const RenderProgress& p) {
  return std::clamp(p.fraction, 0.0, 1.0);
}

}  // namespace

ProgressStyle progress_style(const std::string& name) {
  return name == "bar"     ? ProgressStyle::bar
         : name == "plain" ? ProgressStyle::plain
         : name == "none"  ? ProgressStyle::none
                           : ProgressStyle::automatic;
}

ProgressDisplay::ProgressDisplay(ProgressStyle style, std::string scene, const Batch& batch,
                                 Log& log)
    : style_(style), scene_(std::move(scene)), batch_(batch), log_(log), bar_(log) {
  if (style_ == ProgressStyle::automatic)
    style_ = is_terminal(StandardStream::error) ? ProgressStyle::bar : ProgressStyle::plain;
}

std::string ProgressDisplay::time_left(const RenderProgress& p) const {
  if (!(p.fraction > 0.001)) return "";
  const double left = p.seconds * (1 / fraction_of(p) - 1);
  std::string text = seconds_text(left) + " left";
  if (batch_.is_several())
    text += fmt::format(" (all: {})", seconds_text(batch_.seconds_left(left)));
  return text;
}

std::string ProgressDisplay::bar_line(const RenderProgress& p) const {
  const size_t width = TerminalBar::width();
  const std::string spp = samples(p), seconds = seconds_text(p.seconds);
  const std::string left = time_left(p);
  // What is wanted least goes first where there is no room.
  const std::string shorter[] = {listed({spp, seconds, rate(p), error(p), left}),
                                 listed({spp, seconds, error(p), left}),
                                 listed({spp, error(p), left}), listed({spp, left}), left};
  constexpr size_t kMostBar = 24, kLeastBar = 8;
  const std::string title = batch_.is_several() ? batch_.label() + scene_ + " " : "";
  const auto room = [&](const std::string& text) {
    const size_t others = columns(title) + columns("[] 100 % ") + columns(text);
    return width - std::min(width, others);
  };
  const std::string& text = *std::find_if(std::begin(shorter), std::end(shorter) - 1,
                                          [&](const auto& t) { return room(t) >= kLeastBar; });
  std::string bar;
  if (room(text) >= kLeastBar) {
    const size_t length = std::min(room(text), kMostBar);
    const size_t filled = size_t(fraction_of(p) * double(length));
    bar = "[" + std::string(filled, '#') + std::string(length - filled, '.') + "] ";
  }
  return fmt::format("{}{}{:3.0f} % {}", title, bar, 100 * fraction_of(p), text);
}

void ProgressDisplay::show(const RenderProgress& p) {
  if (style_ == ProgressStyle::plain && p.seconds - last_line_ >= kSecondsBetweenLines) {
    last_line_ = p.seconds;
    log_.info("{}{}: {:.0f} %, {}", batch_.label(), scene_, 100 * fraction_of(p),
              listed({samples(p), seconds_text(p.seconds), rate(p), error(p), time_left(p)}));
  }
  if (style_ == ProgressStyle::bar && log_.level() != Log::Level::quiet) bar_.draw(bar_line(p));
}

}  // namespace duet
