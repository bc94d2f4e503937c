// An image that grows, in a viewer.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "base/messages.h"
#include "evaluate/live/tev_display.h"

namespace duet {

/// Shows the image of one render, as often as that takes less than a hundredth of the time.
class LiveDisplay {
 public:
  /// Without a viewer nothing is shown. The messages get one warning if the viewer fails.
  LiveDisplay(const std::optional<TcpPeer>& viewer, std::string name, Messages& messages);
  /// Gives the last image two seconds to arrive.
  ~LiveDisplay();
  LiveDisplay(const LiveDisplay&) = delete;
  LiveDisplay& operator=(const LiveDisplay&) = delete;

  /// Whether it is time for an image, which is then developed for show().
  bool wants_image();
  void show(const Image& image);

 private:
  using Clock = std::chrono::steady_clock;

  void warn_of_failure();

  std::optional<TevDisplay> tev_;
  std::string name_;
  Messages& messages_;
  Clock::time_point asked_, next_;
};

}  // namespace duet
