// The walls of a box as they are seen from inside, divided into cells.
#pragma once

#include <array>
#include <cmath>

#include "geometry/shape.h"
#include "math/warp.h"

namespace duet {

class BoxWalls {
 public:
  static constexpr int kWalls = 6, kDivisions = 5, kSide = 1 << kDivisions,
                       kCellsOfWall = kSide * kSide, kCells = kWalls * kCellsOfWall;

  /// A box that holds nothing.
  BoxWalls() = default;
  explicit BoxWalls(const Bounds& box) : box_(box) {
    const Vector3f size = box.upper - box.lower;
    for (int k = 0; k < 3; ++k) {
      inverse_size_[k] = 1 / size[k];
      inverse_area_[k] = float(kCellsOfWall) / (size[(k + 1) % 3] * size[(k + 2) % 3]);
    }
  }

  bool holds(const Point3f& p) const {
    return p.x > box_.lower.x && p.y > box_.lower.y && p.z > box_.lower.z && p.x < box_.upper.x &&
           p.y < box_.upper.y && p.z < box_.upper.z;
  }

  /// Where a ray leaves the box.
  struct Exit {
    int wall;
    Point2f at;         ///< on the wall, in [0, 1)²
    float pdf_of_cell;  ///< density per solid angle of the ray, over the probability of its cell
    uint32_t cell() const {
      return uint32_t((wall * kSide + int(at.y * kSide)) * kSide + int(at.x * kSide));
    }
  };
  /// Of a ray from a point that the box holds in a unit direction.
  [[gnu::always_inline]] Exit exit(const Point3f& from, const Vector3f& wi) const {
    // The point is within, so that no distance is 0 / 0.
    const auto distance = [](float low, float high, float x, float w) {
      return (w > 0 ? high - x : x - low) / std::abs(w);
    };
    const float x = distance(box_.lower.x, box_.upper.x, from.x, wi.x);
    const float y = distance(box_.lower.y, box_.upper.y, from.y, wi.y);
    const float z = distance(box_.lower.z, box_.upper.z, from.z, wi.z);
    const float t = std::min(x, std::min(y, z));
    const int axis = t == x ? 0 : t == y ? 1 : 2;
    const std::array<float, 5> p = within(from + wi * t);
    const std::array<float, 3> w = {wi.x, wi.y, wi.z};
    return {2 * axis + (w[size_t(axis)] > 0 ? 1 : 0),
            {p[size_t(axis) + 1], p[size_t(axis) + 2]},
            pdf_of_cell(axis, t * t, std::abs(w[size_t(axis)]))};
  }

  /// A point of a cell, by two numbers in [0, 1).
  Point3f point(uint32_t cell, const Point2f& u) const {
    const int axis = axis_of(cell), next = (axis + 1) % 3, last = (axis + 2) % 3;
    const uint32_t in_wall = cell % kCellsOfWall;
    Point3f p;
    p[axis] = cell / kCellsOfWall % 2 == 1 ? box_.upper[axis] : box_.lower[axis];
    p[next] = lerp(box_.lower[next], box_.upper[next], (float(in_wall % kSide) + u.x) / kSide);
    p[last] = lerp(box_.lower[last], box_.upper[last], (float(in_wall / kSide) + u.y) / kSide);
    return p;
  }
  static int axis_of(uint32_t cell) { return int(cell / (2 * kCellsOfWall)); }
  /// As in Exit, of a ray through a wall across an axis at squared distance `d2`; `w` is the size
  /// of the direction's component along it.
  float pdf_of_cell(int axis, float d2, float w) const {
    return d2 / w * inverse_area_[size_t(axis)];
  }

 private:
  /// In parts of the box, with the first two once more.
  std::array<float, 5> within(const Point3f& p) const {
    const auto part = [](float x) { return std::min(std::max(x, 0.0f), kBelowOne); };
    const float x = part((p.x - box_.lower.x) * inverse_size_[0]);
    const float y = part((p.y - box_.lower.y) * inverse_size_[1]);
    const float z = part((p.z - box_.lower.z) * inverse_size_[2]);
    return {x, y, z, x, y};
  }

  Bounds box_;
  std::array<float, 3> inverse_size_{};
  std::array<float, 3> inverse_area_{};  ///< of a cell of the walls across an axis
};

}  // namespace duet
