// Pixels and bytes as pages hold them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace duet {

/// Bytes in base64 (RFC 4648).
std::string base64(std::span<const uint8_t> bytes);

/// Pixels along each side of a block, so that no side has more blocks than `longest`.
inline int reduction(int width, int height, int longest) {
  return (std::max(width, height) + longest - 1) / longest;
}

/// Calls `use(mean)` for each block of n × n pixels, in rows from the top, with the mean of
/// `value(pixel)` over what there is of it.
template <class Value, class Use>
void for_each_block(int width, int height, int n, Value value, Use use) {
  for (int y = 0; y < height; y += n)
    for (int x = 0; x < width; x += n) {
      const int x1 = std::min(x + n, width), y1 = std::min(y + n, height);
      std::array<double, 3> sum{};
      for (int j = y; j < y1; ++j)
        for (int i = x; i < x1; ++i) {
          const std::array<double, 3> v = value(size_t(j) * size_t(width) + size_t(i));
          for (size_t c = 0; c < 3; ++c) sum[c] += v[c];
        }
      for (double& s : sum) s /= double(x1 - x) * (y1 - y);
      use(sum);
    }
}

}  // namespace duet
