// Points spread evenly over a shape, for what measures on surfaces.
#pragma once

#include "geometry/shape.h"
#include "math/distribution.h"

namespace duet {

/// Chooses points of a shape with the density 1 / area.
class ShapePoints {
 public:
  /// `shape` must stay where it is, have an area, and be none of those that is_even() refuses.
  explicit ShapePoints(const Shape& shape);
  ShapePoint sample(const Point2f& u) const;
  /// Whether points can be spread evenly: not over stretched spheres and cylinders.
  static bool is_even(const Shape& shape);

 private:
  const Shape& shape_;
  DiscreteDistribution triangles_;
};

}  // namespace duet
