#include "evaluate/live/live_display.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

namespace duet {

namespace {

/// Nobody sees more than this.
constexpr std::chrono::milliseconds kLeastTimeBetween{100};
/// How much longer rendering lasts than making an image of it. Sending it, in another thread, takes
/// about as much time again.
constexpr int kRenderTimes = 200;
/// The same for what the thread of the page does with an image.
constexpr int kPageTimes = 100;

}  // namespace

LiveDisplay::LiveDisplay(const std::optional<TcpPeer>& viewer, LivePage* page, std::string name,
                         Messages& messages)
    : page_(page), name_(std::move(name)), messages_(messages) {
  try {
    if (viewer) tev_.emplace(*viewer);
  } catch (const std::system_error& e) {
    messages_.warning("--display: there is no thread for it: {}", e.what());
  }
}

LiveDisplay::~LiveDisplay() {
  if (page_) page_->finish();
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
  if (Clock::now() < next_) return false;
  if (!(tev_ && tev_->is_free()) && !(page_ && page_->wants_image())) return false;
  asked_ = Clock::now();
  return true;
}

void LiveDisplay::show(const RenderResult& so_far) {
  show(so_far, "so far");
  const Clock::time_point now = Clock::now();
  next_ = now + std::max<Clock::duration>(kLeastTimeBetween, kRenderTimes * (now - asked_));
  if (page_)
    next_ = std::max(next_,
                     now + std::chrono::duration_cast<Clock::duration>(kPageTimes * page_->cost()));
}

void LiveDisplay::show_last(const RenderResult& result) {
  show(result, result.interrupted ? "when it was interrupted" : "in the end");
}

void LiveDisplay::show(const RenderResult& result, const char* state) {
  if (tev_) tev_->show(name_, result.image);
  if (page_)
    page_->show(name_, result.image,
                fmt::format("{}: {} samples per pixel {}", name_, result.spp, state));
}

}  // namespace duet
