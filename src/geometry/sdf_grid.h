// Surfaces given by distances on a grid: where the interpolated distance is zero.
// Source of the intersection and of the smooth normals: Hansson-Söderlund, Evans & Akenine-Möller,
// "Ray Tracing of Signed Distance Function Grids", JCGT 11(3), 2022.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "math/vector.h"

namespace duet {

/// Distances at the nodes of a grid that spans the unit cube, interpolated trilinearly.
struct SdfGrid {
  std::array<int, 3> size{2, 2, 2};  ///< number of nodes along x, y and z, each at least 2
  std::vector<float> values;         ///< x fastest, then y, then z
  std::vector<uint32_t> cells;       ///< surface_cells()
  /// Shading normals that are continuous from cell to cell; otherwise those of the interpolation.
  bool smooth_normals = true;
  bool operator==(const SdfGrid&) const = default;

  float at(int x, int y, int z) const {
    return values[(size_t(z) * size_t(size[1]) + size_t(y)) * size_t(size[0]) + size_t(x)];
  }
};

/// The cells of a grid that the surface passes through: indices of the nodes at their lower
/// corners, in increasing order.
std::vector<uint32_t> surface_cells(const SdfGrid& grid);

/// Lower and upper corner of a cell in the unit cube.
void cell_bounds(const SdfGrid& grid, uint32_t cell, Point3f& lower, Point3f& upper);

/// The first t in (tnear, tfar) at which the ray o + t d meets the surface within a cell; empty if
/// there is none.
std::optional<double> intersect_cell(const SdfGrid& grid, uint32_t cell,
                                     const std::array<double, 3>& o, const std::array<double, 3>& d,
                                     double tnear, double tfar);

/// Where and how the surface is near a point within a cell: the point is moved onto it along the
/// gradient. Normals have any length and point to where the distance grows.
struct SdfPoint {
  Point3f position;
  Normal3f geometric, shading;
};
SdfPoint surface_point(const SdfGrid& grid, uint32_t cell, const std::array<double, 3>& p);

}  // namespace duet
