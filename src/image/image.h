// A rectangle of floating-point pixels with named channels.
#pragma once

#include <string>
#include <vector>

#include "math/spectrum.h"

namespace duet {

/// Pixels in rows from the top, channels interleaved; values are linear.
struct Image {
  int width = 0, height = 0;
  std::vector<std::string> channels;
  std::vector<float> data;  ///< height × width × channels

  Image() = default;
  Image(int w, int h, std::vector<std::string> names)
      : width(w), height(h), channels(std::move(names)), data(size_t(w) * h * channels.size()) {}

  int channel_count() const { return int(channels.size()); }
  float* pixel(int x, int y) { return &data[(size_t(y) * width + x) * channels.size()]; }
  const float* pixel(int x, int y) const {
    return &data[(size_t(y) * width + x) * channels.size()];
  }
  /// Index of the channel with this name, or −1.
  int find_channel(const std::string& name) const {
    for (int i = 0; i < channel_count(); ++i)
      if (channels[i] == name) return i;
    return -1;
  }
};

}  // namespace duet
