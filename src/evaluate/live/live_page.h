// A page that shows an image as it grows.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

#include "base/http_server.h"
#include "image/image.h"

namespace duet {

/// Serves the viewer of the reports on the loopback interface, with the image of the render that is
/// under way. Whoever looks asks twice a second for an image that is newer than the one it has; as
/// long as nobody does, no image is made.
class LivePage {
 public:
  /// Port 0 is any that is free. Throws std::system_error if the port is taken, or if there is no
  /// thread.
  explicit LivePage(uint16_t port);

  std::string url() const;
  /// Whether somebody looks, and has the image before.
  bool wants_image() const;
  /// Shows an image; `state` is said beside it. Returns at once.
  void show(const std::string& name, Image image, const std::string& state);
  /// Gives whoever looks two seconds to fetch the image that was shown last.
  void finish() const;
  /// CPU time that one image takes: that of the last one that was fetched.
  std::chrono::duration<double> cost() const;

 private:
  struct Shown {
    std::string name, state;
    Image image;
    uint64_t number = 0;  ///< counted from 1
  };

  HttpAnswer answer(const std::string& target);
  HttpAnswer answer_image(uint64_t after);

  mutable std::mutex mutex_;
  std::shared_ptr<const Shown> shown_ = std::make_shared<Shown>();
  uint64_t fetched_ = 0;
  std::chrono::steady_clock::time_point asked_{};  ///< when somebody asked last
  std::chrono::duration<double> cost_{};
  HttpServer server_;  ///< ends first
};

}  // namespace duet
