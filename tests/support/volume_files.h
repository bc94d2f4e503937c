// Writes .vol files.
#pragma once

#include <string>
#include <vector>

#include "support/files.h"

namespace duet::test {

/// A file of Mitsuba's format in a box from (−1, 0, 0) to (1, 2, 4).
struct VolumeText {
  int version = 3, encoding = 1, x = 2, y = 1, z = 1, channels = 1;
  std::vector<float> box{-1, 0, 0, 1, 2, 4};
  std::string values;

  std::string text() const {
    std::string s = "VOL" + pack(uint8_t(version), encoding, x, y, z, channels);
    for (const float v : box) s += pack(v);
    return s + values;
  }
};

/// A grid of 32-bit numbers.
inline std::string float_volume(int x, int y, int z, int channels,
                                const std::vector<float>& values) {
  VolumeText file{.x = x, .y = y, .z = z, .channels = channels, .values = {}};
  for (const float v : values) file.values += pack(v);
  return file.text();
}

}  // namespace duet::test
