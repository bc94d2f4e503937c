#include "evaluate/live/tev_message.h"

#include <array>
#include <bit>
#include <cstring>
#include <stdexcept>

namespace duet {

namespace {

static_assert(std::endian::native == std::endian::little);

enum class Kind : uint8_t { update_image = 3, create_image = 4 };

class Message {
 public:
  explicit Message(Kind kind) : bytes_(sizeof(uint32_t)) { bytes_.push_back(uint8_t(kind)); }

  void add(bool value) { bytes_.push_back(uint8_t(value)); }
  void add(const std::string& text) {
    // What follows a zero would be read as the next field.
    bytes_.insert(bytes_.end(), text.begin(), text.begin() + std::strlen(text.c_str()));
    bytes_.push_back(0);
  }
  void add(int32_t value) { add_raw(value); }
  void add(float value) { add_raw(value); }
  void reserve(size_t more) { bytes_.reserve(bytes_.size() + more); }

  std::vector<uint8_t> finish() {
    if (bytes_.size() > UINT32_MAX) throw std::length_error("the image is too large for tev");
    const auto length = uint32_t(bytes_.size());
    std::memcpy(bytes_.data(), &length, sizeof(length));
    return std::move(bytes_);
  }

 private:
  template <class T>
  void add_raw(T value) {
    const auto raw = std::bit_cast<std::array<uint8_t, sizeof(T)>>(value);
    bytes_.insert(bytes_.end(), raw.begin(), raw.end());
  }

  std::vector<uint8_t> bytes_;
};

/// Whether the viewer shows the image at once: not instead of what somebody looks at.
constexpr bool kGrabsFocus = false;

}  // namespace

std::vector<uint8_t> tev_create_image(const std::string& name, const Image& image) {
  Message m(Kind::create_image);
  m.add(kGrabsFocus);
  m.add(name);
  m.add(int32_t(image.width));
  m.add(int32_t(image.height));
  m.add(int32_t(image.channel_count()));
  for (const std::string& channel : image.channels) m.add(channel);
  return m.finish();
}

std::vector<uint8_t> tev_update_channel(const std::string& name, const Image& image,
                                        size_t channel) {
  Message m(Kind::update_image);
  m.add(kGrabsFocus);
  m.add(name);
  m.add(image.channels[channel]);
  for (const int v : {0, 0, image.width, image.height}) m.add(int32_t(v));
  m.reserve(image.data.size() / image.channels.size() * sizeof(float));
  for (size_t i = channel; i < image.data.size(); i += image.channels.size()) m.add(image.data[i]);
  return m.finish();
}

}  // namespace duet
