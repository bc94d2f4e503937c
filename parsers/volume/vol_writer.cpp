#include "volume/vol_writer.h"

#include <bit>
#include <cstring>

namespace duet {

static_assert(std::endian::native == std::endian::little, "files are written as memory has them");

std::string vol_bytes(const VolumeGrid& grid) {
  std::string out = "VOL\x03";
  const auto append = [&](const auto& value) {
    char bytes[sizeof(value)];
    std::memcpy(bytes, &value, sizeof(value));
    out.append(bytes, sizeof(value));
  };
  append(int32_t(1));  // 32-bit floating-point numbers
  for (const int n : grid.size) append(int32_t(n));
  append(int32_t(grid.channels));
  for (const float x : grid.lower) append(x);
  for (const float x : grid.upper) append(x);
  for (const float x : grid.values) append(x);
  return out;
}

}  // namespace duet
