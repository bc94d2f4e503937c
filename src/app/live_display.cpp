#include "app/live_display.h"

#include <algorithm>
#include <limits>

#include "app/arguments.h"
#include "app/commands.h"

namespace duet {

namespace {

/// Nobody sees more than this.
constexpr std::chrono::milliseconds kLeastTimeBetween{100};
/// How much longer rendering lasts than making an image of it.
constexpr int kRenderTimes = 100;

}  // namespace

TcpAddress parse_viewer(const std::string& text) {
  constexpr std::string_view scheme = "tev";
  const auto refuse = [&] {
    throw UsageError(
        fmt::format("--display {}: a viewer is tev, tev://HOST or tev://HOST:PORT", text));
  };
  TcpAddress viewer;
  viewer.port = kTevPort;
  if (text == scheme) return viewer;
  if (!text.starts_with("tev://")) refuse();
  std::string host = text.substr(6), port;
  // An IPv6 address has colons of its own.
  const size_t bracket = host.find(']'), colon = host.find(':', bracket == host.npos ? 0 : bracket);
  if (colon != host.npos) {
    port = host.substr(colon + 1);
    host.erase(colon);
    viewer.port = uint16_t(
        parse_whole("--display", port, 1, std::numeric_limits<decltype(viewer.port)>::max()));
  }
  if (host.starts_with('[')) {
    if (!host.ends_with(']')) refuse();
    host = host.substr(1, host.size() - 2);
  }
  if (host.empty()) refuse();
  viewer.host = host;
  return viewer;
}

LiveDisplay::LiveDisplay(const std::optional<TcpAddress>& viewer, std::string name, Log& log)
    : name_(std::move(name)) {
  if (viewer) tev_.emplace(*viewer, [&log](const std::string& text) { log.warning("{}", text); });
}

bool LiveDisplay::wants_image() {
  if (!tev_ || !tev_->is_free() || Clock::now() < next_) return false;
  asked_ = Clock::now();
  return true;
}

void LiveDisplay::show(const Image& image) {
  if (!tev_) return;
  tev_->show(name_, image);
  const Clock::time_point now = Clock::now();
  next_ = now + std::max<Clock::duration>(kLeastTimeBetween, kRenderTimes * (now - asked_));
}

}  // namespace duet
