// Feeds arbitrary bytes to the reader of .vol files.
#include <cmath>
#include <cstdlib>

#include "volume/vol_file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const auto require = [](bool condition) {
    if (!condition) std::abort();
  };
  try {
    duet::ByteReader in("fuzz", {data, size});
    const duet::VolumeGrid grid = duet::parse_vol(in).grid;
    require(grid.channels == 1 || grid.channels == 3 || grid.channels == 6);
    require(grid.node_count() >= 1);
    require(grid.values.size() == grid.node_count() * size_t(grid.channels));
    for (const float v : grid.values) require(std::isfinite(v));
    for (size_t i = 0; i < 3; ++i) require(grid.lower[i] < grid.upper[i]);
  } catch (const duet::ReadError&) {
  }
  return 0;
}
