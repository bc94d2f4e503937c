// A grid as pbrt has them: cells with a value in the middle, and nothing beyond.
#pragma once

#include <array>

#include "scene/description.h"

namespace duet::pbrt {

/// Between the middles of cells pbrt interpolates, and beyond the outermost it fades out over half
/// a cell. The descriptions of its grids have a layer of zeros around the cells for that: it is no
/// part of them here. A grid without such a layer is taken as it is.
class GridCells {
 public:
  explicit GridCells(const VolumeDescription& volume);

  const std::array<int, 3>& size() const { return size_; }
  size_t count() const { return size_t(size_[0]) * size_t(size_[1]) * size_t(size_[2]); }
  int channels() const { return volume_.grid->channels; }
  /// Whether zeros were around them, so that nothing changes where the grid ends.
  bool fades() const { return border_ > 0; }
  /// Of a cell, x fastest; of the only channel for any.
  float value(size_t cell, int channel) const;
  /// The same between cells, at the place of a cell of another grid.
  float value(const GridCells& other, size_t cell, int channel) const;
  /// To the world from the space in which cells are unit cubes, the first at the origin.
  const Matrix4& to_world() const { return to_world_; }
  /// Whether both fill the same box.
  bool has_box_of(const GridCells& other) const;
  /// Whether both have the same cells.
  bool matches(const GridCells& other) const { return size_ == other.size_ && has_box_of(other); }

 private:
  std::array<int, 3> index_of(size_t cell) const;
  float node(const std::array<int, 3>& index, int channel) const;

  const VolumeDescription& volume_;
  std::array<int, 3> size_;
  int border_ = 0;
  Matrix4 to_world_;
};

}  // namespace duet::pbrt
