// An image that grows, in a viewer or on a page.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "base/messages.h"
#include "evaluate/live/live_page.h"
#include "evaluate/live/tev_display.h"
#include "integrators/pass.h"

namespace duet {

/// Shows the image of one render, as often as that takes about a hundredth of the time.
class LiveDisplay {
 public:
  /// Without a viewer and without a page (null) nothing is shown. The messages get one warning if
  /// the viewer fails.
  LiveDisplay(const std::optional<TcpPeer>& viewer, LivePage* page, std::string name,
              Messages& messages);
  /// Gives the last image two seconds to arrive, each of them.
  ~LiveDisplay();
  LiveDisplay(const LiveDisplay&) = delete;
  LiveDisplay& operator=(const LiveDisplay&) = delete;

  /// Whether it is time for an image, which is then developed for show().
  bool wants_image();
  void show(const RenderResult& so_far);
  void show_last(const RenderResult& result);

 private:
  using Clock = std::chrono::steady_clock;

  void warn_of_failure();
  void show(const RenderResult& result, const char* state);

  std::optional<TevDisplay> tev_;
  LivePage* page_;
  std::string name_;
  Messages& messages_;
  Clock::time_point asked_, next_;
};

}  // namespace duet
