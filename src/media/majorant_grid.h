// A coarse grid of upper bounds that rays are tracked through.
#pragma once

#include <vector>

#include "media/volume.h"

namespace duet {

/// Upper bounds of a GridVolume or CloudVolume over the cells of a coarse grid. It covers the
/// volume's box in the world (GridVolume::world_box), which is more than its unit cube if the
/// volume is turned.
class MajorantGrid {
 public:
  /// The bounds are those of the volume times `scale`.
  template <class Volume>
  MajorantGrid(const Volume& volume, float scale);

  /// Calls visit(t0, t1, majorant) for the stretches of a ray up to ray.tmax that lie in the
  /// volume's box in the world, cell by cell, until it returns false. `origin` and `direction` are
  /// those of the ray in the volume's own space.
  template <class Visit>
  void traverse(const Ray& ray, const Point3f& origin, const Vector3f& direction,
                Visit visit) const;

 private:
  /// In the world, and in the volume's own space.
  Point3f world_lower_, world_upper_, lower_;
  Vector3f cell_;  ///< its size
  std::array<int, 3> size_;
  std::vector<float> majorants_;
};

/// Source: Amanatides & Woo, "A fast voxel traversal algorithm for ray tracing", 1987.
template <class Visit>
inline void MajorantGrid::traverse(const Ray& ray, const Point3f& origin, const Vector3f& direction,
                                   Visit visit) const {
  float t = 0, end = ray.tmax;
  for (int i = 0; i < 3; ++i) {
    const float inverse = 1 / ray.direction[i];
    float a = (world_lower_[i] - ray.origin[i]) * inverse;
    float b = (world_upper_[i] - ray.origin[i]) * inverse;
    if (a > b) std::swap(a, b);
    if (ray.direction[i] == 0) {
      if (!(ray.origin[i] >= world_lower_[i] && ray.origin[i] <= world_upper_[i])) return;
      continue;
    }
    t = std::max(t, a);
    end = std::min(end, b);
  }
  if (!(t < end)) return;
  int cell[3], step[3];
  float next[3], delta[3];
  for (int i = 0; i < 3; ++i) {
    const int n = size_[size_t(i)];
    const float x = (origin[i] + direction[i] * t - lower_[i]) / cell_[i];
    cell[i] = std::clamp(int(x), 0, n - 1);
    step[i] = direction[i] < 0 ? -1 : 1;
    if (direction[i] == 0) {
      next[i] = delta[i] = INFINITY;
      continue;
    }
    const float border = lower_[i] + float(cell[i] + (step[i] > 0)) * cell_[i];
    next[i] = (border - origin[i]) / direction[i];
    delta[i] = cell_[i] / std::abs(direction[i]);
  }
  for (;;) {
    const int axis = next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
    const float t1 = std::min(next[axis], end);
    if (t1 > t) {
      const size_t index =
          (size_t(cell[2]) * size_t(size_[1]) + size_t(cell[1])) * size_t(size_[0]) +
          size_t(cell[0]);
      if (!visit(t, t1, majorants_[index])) return;
      t = t1;
    }
    if (!(t < end)) return;
    cell[axis] += step[axis];
    // Only rounding can lead beyond the last cell while there is some way left.
    cell[axis] = std::clamp(cell[axis], 0, size_[size_t(axis)] - 1);
    next[axis] += delta[axis];
  }
}

}  // namespace duet
