#include "media/majorant_grid.h"

#include "media/cloud.h"

namespace duet {

namespace {

/// Cells this many nodes wide: small enough to hug the volume, large enough that stepping through
/// them costs less than the collisions it saves.
constexpr int kNodesPerCell = 8;
constexpr int kMostCells = 64;

}  // namespace

template <class Volume>
MajorantGrid::MajorantGrid(const Volume& volume, float scale) {
  volume.world_box(world_lower_, world_upper_);
  Point3f upper;
  map_box([&](const Point3f& p) { return volume.to_local(p); }, world_lower_, world_upper_, lower_,
          upper);
  for (int i = 0; i < 3; ++i) {
    int& n = size_[size_t(i)];
    const float extent = upper[i] - lower_[i];
    n = std::clamp(int(extent * float(volume.resolution()[size_t(i)]) / kNodesPerCell), 1,
                   kMostCells);
    cell_[i] = extent / float(n);
  }
  majorants_.reserve(size_t(size_[0]) * size_t(size_[1]) * size_t(size_[2]));
  for (int z = 0; z < size_[2]; ++z)
    for (int y = 0; y < size_[1]; ++y)
      for (int x = 0; x < size_[0]; ++x) {
        const Point3f a =
            lower_ + Vector3f(float(x) * cell_.x, float(y) * cell_.y, float(z) * cell_.z);
        majorants_.push_back(volume.maximum(a, a + cell_) * scale);
      }
}

template MajorantGrid::MajorantGrid(const GridVolume&, float);
template MajorantGrid::MajorantGrid(const CloudVolume&, float);

}  // namespace duet
