// Shows images that grow in tev, without making whoever renders them wait.
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "base/system/tcp.h"
#include "image/image.h"

namespace duet {

/// The port that tev listens to unless it is told otherwise.
inline constexpr uint16_t kTevPort = 14158;

/// Sends images from a thread of its own. If the viewer is not there, hangs or goes away, the next
/// image is another attempt.
class TevDisplay {
 public:
  /// Throws std::system_error if there is no thread to be had.
  explicit TevDisplay(TcpPeer viewer);
  ~TevDisplay();
  TevDisplay(const TevDisplay&) = delete;
  TevDisplay& operator=(const TevDisplay&) = delete;

  /// Whether the image before is out of the way.
  bool is_free() const { return is_free_.load(); }
  /// Shows an image, which replaces one of the same name that was shown before, and one that waits
  /// to be sent. Returns at once.
  void show(const std::string& name, Image image);
  /// Ends the thread. The last image that was shown is still sent, if that takes no longer than two
  /// seconds; nothing is shown afterwards.
  void finish();
  /// Why an image could not be shown, for the first time; "" before that, and for whoever asks
  /// again.
  std::string take_failure();

 private:
  struct Shown {
    std::string name;
    Image image;
  };

  void work();
  void send(const Shown& shown);

  const TcpPeer viewer_;
  std::atomic<bool> is_free_{true}, cancel_{false};
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Shown> waiting_;
  std::string failure_;
  bool ends_ = false, is_sending_ = false;

  // Of the thread alone.
  std::optional<TcpConnection> connection_;
  Shown created_;  ///< the image that the viewer has, without its values
  bool has_failed_ = false;
  std::thread thread_;
};

}  // namespace duet
