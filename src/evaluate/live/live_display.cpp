#include "evaluate/live/live_display.h"

#include <algorithm>
#include <system_error>

namespace duet {

namespace {

/// Nobody sees more than this.
constexpr std::chrono::milliseconds kLeastTimeBetween{100};
/// How much longer rendering lasts than making an image of it. Sending it, in another thread, takes
/// about as much time again.
constexpr int kRenderTimes = 200;

}  // namespace

LiveDisplay::LiveDisplay(const std::optional<TcpPeer>& viewer, std::string name, Messages& messages)
    : name_(std::move(name)), messages_(messages) {
  try {
    if (viewer) tev_.emplace(*viewer);
  } catch (const std::system_error& e) {
    messages_.warning("--display: there is no thread for it: {}", e.what());
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
    messages_.warning("{}", failure);
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
