// --display: an image that grows, in a viewer.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "base/log.h"
#include "evaluate/live/tev_display.h"

namespace duet {

/// The viewer that --display names: "tev", "tev://host" or "tev://host:port". Throws UsageError.
TcpAddress parse_viewer(const std::string& text);

/// Shows the image of one render, as often as that takes less than a hundredth of the time.
class LiveDisplay {
 public:
  /// Without a viewer nothing is shown.
  LiveDisplay(const std::optional<TcpAddress>& viewer, std::string name, Log& log);

  /// Whether it is time for an image, which is then developed for show().
  bool wants_image();
  void show(const Image& image);

 private:
  using Clock = std::chrono::steady_clock;

  std::optional<TevDisplay> tev_;
  std::string name_;
  Clock::time_point asked_, next_;
};

}  // namespace duet
