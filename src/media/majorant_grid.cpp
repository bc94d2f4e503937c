#include "media/majorant_grid.h"

namespace duet {

namespace {

/// Cells this many nodes wide: small enough to hug the volume, large enough that stepping through
/// them costs less than the collisions it saves.
constexpr int kNodesPerCell = 8;
constexpr int kMostCells = 64;

}  // namespace

MajorantGrid::MajorantGrid(const GridVolume& volume, float scale) {
  for (size_t i = 0; i < 3; ++i)
    size_[i] = std::clamp(volume.grid().size[i] / kNodesPerCell, 1, kMostCells);
  majorants_.reserve(size_t(size_[0]) * size_t(size_[1]) * size_t(size_[2]));
  for (int z = 0; z < size_[2]; ++z)
    for (int y = 0; y < size_[1]; ++y)
      for (int x = 0; x < size_[0]; ++x) {
        const Point3f lower(float(x) / float(size_[0]), float(y) / float(size_[1]),
                            float(z) / float(size_[2]));
        const Point3f upper(float(x + 1) / float(size_[0]), float(y + 1) / float(size_[1]),
                            float(z + 1) / float(size_[2]));
        majorants_.push_back(volume.maximum(lower, upper) * scale);
      }
}

}  // namespace duet
