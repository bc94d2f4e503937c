#include "volume/surface_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "base/diagnostics.h"

namespace duet {

SdfGrid surface_of(const VolumeGrid& volume, const std::string& name) {
  if (volume.channels != 1)
    throw ReadError(fmt::format("{} has {} channels: distances have one", name, volume.channels));
  if (*std::min_element(volume.size.begin(), volume.size.end()) < 2)
    throw ReadError(name + " needs two nodes at least along each axis");
  if (volume.node_count() > size_t(std::numeric_limits<int>::max()))
    throw ReadError(name + " has too many nodes");
  SdfGrid grid;
  grid.size = volume.size;
  grid.values = volume.values;
  grid.smooth_normals = true;
  grid.cells = surface_cells(grid);
  if (grid.cells.empty()) throw ReadError(name + " is nowhere zero: it has no surface");
  return grid;
}

}  // namespace duet
