// A coarse grid of upper bounds that rays are tracked through.
#pragma once

#include <vector>

#include "media/volume.h"

namespace duet {

/// Upper bounds of a volume over the cells of a coarse grid of its unit cube.
class MajorantGrid {
 public:
  /// The bounds are those of the volume times `scale`.
  MajorantGrid(const GridVolume& volume, float scale);

  /// Calls visit(t0, t1, majorant) for the stretches of a ray that lie in the cells of the unit
  /// cube, in order, until it returns false. `origin` and `direction` are given in the volume's own
  /// space; t keeps its meaning.
  template <class Visit>
  void traverse(const Point3f& origin, const Vector3f& direction, float tmax, Visit visit) const;

 private:
  std::array<int, 3> size_;
  std::vector<float> majorants_;
};

/// Source: Amanatides & Woo, "A fast voxel traversal algorithm for ray tracing", 1987.
template <class Visit>
inline void MajorantGrid::traverse(const Point3f& origin, const Vector3f& direction, float tmax,
                                   Visit visit) const {
  float t = 0, end = tmax;
  for (int i = 0; i < 3; ++i) {
    const float inverse = 1 / direction[i];
    float a = -origin[i] * inverse, b = (1 - origin[i]) * inverse;
    if (a > b) std::swap(a, b);
    if (direction[i] == 0) {
      if (!(origin[i] >= 0 && origin[i] <= 1)) return;
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
    const float x = (origin[i] + direction[i] * t) * float(n);
    cell[i] = std::clamp(int(x), 0, n - 1);
    step[i] = direction[i] < 0 ? -1 : 1;
    if (direction[i] == 0) {
      next[i] = delta[i] = INFINITY;
      continue;
    }
    const float border = float(cell[i] + (step[i] > 0)) / float(n);
    next[i] = (border - origin[i]) / direction[i];
    delta[i] = 1 / (std::abs(direction[i]) * float(n));
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
    if (cell[axis] < 0 || cell[axis] >= size_[size_t(axis)]) return;
    next[axis] += delta[axis];
  }
}

}  // namespace duet
