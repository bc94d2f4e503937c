#include "evaluate/live/tev_display.h"

#include <fmt/format.h>

#include <chrono>
#include <stdexcept>
#include <utility>

#include "evaluate/live/tev_message.h"

namespace duet {

namespace {

constexpr double kSecondsToConnect = 1;
/// A viewer that takes no byte for so long is given up.
constexpr double kSecondsOfPatience = 5;
constexpr std::chrono::seconds kTimeAtEnd{2};

}  // namespace

TevDisplay::TevDisplay(TcpPeer viewer) : viewer_(std::move(viewer)), thread_([this] { work(); }) {}

TevDisplay::~TevDisplay() {
  finish();
}

void TevDisplay::finish() {
  if (!thread_.joinable()) return;
  std::unique_lock lock(mutex_);
  ends_ = true;
  changed_.notify_all();
  changed_.wait_for(lock, kTimeAtEnd, [&] { return !waiting_ && !is_sending_; });
  cancel_ = true;
  lock.unlock();
  thread_.join();
}

void TevDisplay::show(const std::string& name, Image image) {
  const std::lock_guard lock(mutex_);
  waiting_ = Shown{name, std::move(image)};
  is_free_ = false;
  changed_.notify_all();
}

std::string TevDisplay::take_failure() {
  const std::lock_guard lock(mutex_);
  return std::exchange(failure_, "");
}

void TevDisplay::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return waiting_ || ends_; });
    if (!waiting_ || cancel_.load()) return;
    const Shown shown = *std::exchange(waiting_, std::nullopt);
    is_sending_ = true;
    lock.unlock();
    send(shown);
    lock.lock();
    is_sending_ = false;
    is_free_ = !waiting_;
    changed_.notify_all();
  }
}

void TevDisplay::send(const Shown& shown) {
  const auto transmit = [&](const std::vector<uint8_t>& message) {
    connection_->send(message, kSecondsOfPatience, cancel_);
  };
  try {
    if (!connection_) {
      connection_.emplace(viewer_, kSecondsToConnect);
      created_ = {};
    }
    const Image& image = shown.image;
    if (created_.name != shown.name || created_.image.width != image.width ||
        created_.image.height != image.height || created_.image.channels != image.channels) {
      transmit(tev_create_image(shown.name, image));
      created_ = {shown.name, {}};
      created_.image.width = image.width, created_.image.height = image.height;
      created_.image.channels = image.channels;
    }
    for (size_t c = 0; c < image.channels.size(); ++c)
      transmit(tev_update_channel(shown.name, image, c));
  } catch (const std::exception& e) {
    connection_.reset();
    if (std::exchange(has_failed_, true)) return;
    const std::lock_guard lock(mutex_);
    failure_ = fmt::format("tev at {} does not show {}: {}", viewer_.address().text(), shown.name,
                           e.what());
  }
}

}  // namespace duet
