#include "pbrt/grid_cells.h"

#include <algorithm>
#include <cmath>

namespace duet::pbrt {

namespace {

bool has_zeros_around(const VolumeGrid& grid) {
  const auto& n = grid.size;
  if (std::min({n[0], n[1], n[2]}) < 3) return false;
  size_t node = 0;
  for (int z = 0; z < n[2]; ++z)
    for (int y = 0; y < n[1]; ++y)
      for (int x = 0; x < n[0]; ++x, ++node) {
        const bool outermost =
            x == 0 || y == 0 || z == 0 || x == n[0] - 1 || y == n[1] - 1 || z == n[2] - 1;
        for (int c = 0; outermost && c < grid.channels; ++c)
          if (grid.values[node * size_t(grid.channels) + size_t(c)] != 0) return false;
      }
  return true;
}

}  // namespace

GridCells::GridCells(const VolumeDescription& volume)
    : volume_(volume),
      border_(volume.nodes == VolumeNodes::beyond || has_zeros_around(*volume.grid) ? 1 : 0) {
  const auto& n = volume.grid->size;
  for (size_t i = 0; i < 3; ++i) size_[i] = n[i] - 2 * border_;
  // In the cube there are n cells, one less, or two less, by where its faces cut the outermost.
  const int missing = int(volume.nodes);
  const auto step = [&](size_t i) { return 1.0 / std::max(n[i] - missing, 1); };
  const double shift = border_ - 0.5 * missing;
  to_world_ = volume.to_world * Matrix4::scale(step(0), step(1), step(2)) *
              Matrix4::translate(shift, shift, shift);
}

std::array<int, 3> GridCells::index_of(size_t cell) const {
  const size_t row = size_t(size_[0]), layer = row * size_t(size_[1]);
  return {int(cell % row), int(cell / row % size_t(size_[1])), int(cell / layer)};
}

float GridCells::node(const std::array<int, 3>& index, int channel) const {
  const VolumeGrid& grid = *volume_.grid;
  size_t node = 0;
  for (size_t i = 3; i-- > 0;)
    node = node * size_t(grid.size[i]) + size_t(std::clamp(index[i], 0, size_[i] - 1) + border_);
  return grid.values[node * size_t(grid.channels) + size_t(std::min(channel, grid.channels - 1))];
}

float GridCells::value(size_t cell, int channel) const {
  return node(index_of(cell), channel);
}

float GridCells::value(const GridCells& other, size_t cell, int channel) const {
  if (matches(other)) return value(cell, channel);
  const std::array<int, 3> from = other.index_of(cell);
  const Matrix4 across = to_world_.inverse().value_or(Matrix4{}) * other.to_world_;
  std::array<int, 3> low;
  std::array<double, 3> share;
  for (size_t i = 0; i < 3; ++i) {
    double x = across[int(i)][3] - 0.5;
    for (size_t k = 0; k < 3; ++k) x += across[int(i)][k] * (from[k] + 0.5);
    low[i] = int(std::floor(std::clamp(x, -1.0, double(size_[i]))));
    share[i] = std::clamp(x - low[i], 0.0, 1.0);
  }
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1;
    std::array<int, 3> at;
    for (size_t i = 0; i < 3; ++i) {
      const bool high = corner >> i & 1;
      weight *= high ? share[i] : 1 - share[i];
      at[i] = low[i] + high;
    }
    sum += weight * double(node(at, channel));
  }
  return float(sum);
}

bool GridCells::has_box_of(const GridCells& other) const {
  const auto box = [](const GridCells& g) {
    return g.to_world_ * Matrix4::scale(g.size_[0], g.size_[1], g.size_[2]);
  };
  const Matrix4 a = box(*this), b = box(other);
  double largest = 0, difference = 0;
  for (int i = 0; i < 3; ++i)
    for (size_t k = 0; k < 4; ++k) {
      largest = std::max(largest, std::abs(a[i][k]));
      difference = std::max(difference, std::abs(a[i][k] - b[i][k]));
    }
  return difference <= 1e-9 * largest;
}

}  // namespace duet::pbrt
