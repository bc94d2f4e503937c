// A density on the unit square that follows weighted points: a quadtree, constant in its leaves.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "math/vector.h"

namespace duet {

class SquareTree {
 public:
  struct Record {
    Point2f at;  ///< in [0, 1)²
    float weight;
  };

  /// Uniform.
  SquareTree() = default;
  /// In proportion to the weights, which are not negative, but for a share of `uniform` in (0, 1].
  /// Reorders the records.
  SquareTree(std::span<Record> records, float uniform);

  /// Quadrants are not divided more often.
  static constexpr int kDeepest = 12;

  /// The density at a point, per area of the square; the mean over the quadrant around it after so
  /// many divisions.
  float density(Point2f p, int divisions = kDeepest) const;
  /// Warps a uniform point: into one with density() of this tree, which is returned in `density`.
  Point2f sample(Point2f u, float& density) const;

 private:
  /// Four quadrants: bit 0 of their number is the half in x, bit 1 that in y.
  struct Node {
    std::array<float, 4> share;          ///< of the node's mass; their sum is one
    std::array<uint32_t, 4> child = {};  ///< 0: the quadrant is a leaf
  };
  struct Building;

  uint32_t divide(const Building& all, std::span<Record> records, Point2f corner, int depth);

  std::vector<Node> nodes_;
};

}  // namespace duet
