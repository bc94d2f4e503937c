#include "app/live_display.h"

#include <algorithm>
#include <limits>
#include <system_error>

#include "app/arguments.h"
#include "app/commands.h"

namespace duet {

namespace {

/// Nobody sees more than this.
constexpr std::chrono::milliseconds kLeastTimeBetween{100};
/// How much longer rendering lasts than making an image of it. Sending it, in another thread, takes
/// about as much time again.
constexpr int kRenderTimes = 200;

TcpPeer find_viewer(const TcpAddress& viewer) {
  try {
    return TcpPeer(viewer);
  } catch (const std::runtime_error& e) {
    throw UsageError(fmt::format("--display: {}", e.what()));
  }
}

}  // namespace

TcpPeer parse_viewer(const std::string& text) {
  constexpr std::string_view scheme = "tev";
  const auto refuse = [&] {
    throw UsageError(
        fmt::format("--display {}: a viewer is tev, tev://HOST or tev://HOST:PORT", text));
  };
  TcpAddress viewer;
  viewer.port = kTevPort;
  if (text == scheme) return find_viewer(viewer);
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
  return find_viewer(viewer);
}

LiveDisplay::LiveDisplay(const std::optional<TcpPeer>& viewer, std::string name, Log& log)
    : name_(std::move(name)), log_(log) {
  try {
    if (viewer) tev_.emplace(*viewer);
  } catch (const std::system_error& e) {
    log_.warning("--display: there is no thread for it: {}", e.what());
  }
}

LiveDisplay::~LiveDisplay() {
  if (!tev_) return;
  tev_->finish();
  warn_of_failure();
}

/// From the thread that renders: what draws a progress bar makes room for one message at a time.
void LiveDisplay::warn_of_failure() {
  if (const std::string failure = tev_->take_failure(); !failure.empty())
    log_.warning("{}", failure);
}

bool LiveDisplay::wants_image() {
  if (tev_) warn_of_failure();
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
