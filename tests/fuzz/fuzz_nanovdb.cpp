// Feeds damaged NanoVDB files to their reader. A file is too long to be guessed: the input says
// which bytes of a good one change.
#include <nanovdb/util/GridBuilder.h>
#include <nanovdb/util/IO.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <vector>

#include "support/files.h"
#include "volume/nanovdb_file.h"

namespace {

std::vector<uint8_t> good_file() {
  const duet::test::TemporaryDirectory directory;
  const std::string path = directory.path("a.nvdb");
  nanovdb::GridBuilder<float> builder(0.0f, nanovdb::GridClass::FogVolume);
  auto values = builder.getAccessor();
  for (int i = 0; i < 20; ++i) values.setValue({i - 9, i * i % 7, -i}, float(i));
  nanovdb::io::writeGrid(path, builder.getHandle(1.0, nanovdb::Vec3d(0), "density"));
  const std::string bytes = duet::test::read_file(path);
  return {bytes.begin(), bytes.end()};
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const std::vector<uint8_t> good = good_file();
  std::vector<uint8_t> file = good;
  // Three bytes of a place, one of a number of bytes, and the bytes.
  while (size >= 5) {
    const size_t place = (size_t(data[0]) << 16 | size_t(data[1]) << 8 | data[2]) % file.size();
    const size_t count = std::min({size_t(data[3] % 16 + 1), size - 4, file.size() - place});
    std::copy_n(data + 4, count, file.begin() + std::ptrdiff_t(place));
    data += 4 + count, size -= 4 + count;
  }
  if (size == 1) file.resize(file.size() * data[0] / 256);
  try {
    duet::ByteReader in("fuzz", {file.data(), file.size()});
    const duet::NanoVdbGrid read = duet::parse_nanovdb(in, "density");
    if (read.grid.values.size() != read.grid.node_count() || !read.to_world.is_finite())
      std::abort();
    for (const float v : read.grid.values)
      if (!std::isfinite(v)) std::abort();
  } catch (const duet::ReadError&) {
  }
  return 0;
}
