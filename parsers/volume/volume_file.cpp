#include "volume/volume_file.h"

#include <fmt/format.h>

#include "values/text.h"
#include "volume/nanovdb_file.h"

namespace duet {

bool is_nanovdb(const std::string& file) {
  return to_lower(file).ends_with(".nvdb");
}

VolumeFile read_volume(const std::string& file) {
  if (!is_nanovdb(file)) return read_vol(file);
  NanoVdbGrid read = read_nanovdb(file, "density");
  VolumeFile out{std::move(read.grid), false};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      if (i != j && read.to_world[i][j] != 0)
        throw ReadError(fmt::format("{}: the grid does not lie along the axes", file));
    if (!(read.to_world[i][i] > 0)) throw ReadError(fmt::format("{}: the grid is mirrored", file));
    out.grid.lower[size_t(i)] = float(read.to_world[i][3]);
    out.grid.upper[size_t(i)] = float(read.to_world[i][3] + read.to_world[i][i]);
  }
  return out;
}

Matrix4 box_to_world(const VolumeGrid& grid) {
  const auto& a = grid.lower;
  const auto& b = grid.upper;
  return Matrix4::translate(double(a[0]), double(a[1]), double(a[2])) *
         Matrix4::scale(double(b[0]) - double(a[0]), double(b[1]) - double(a[1]),
                        double(b[2]) - double(a[2]));
}

}  // namespace duet
