// The doorway to cameras.
#pragma once

#include "math/transform.h"
#include "math/vector.h"

namespace duet {

/// A sensor in front of the scene. Film positions are in pixels of the full image, from the top
/// left.
class Camera {
 public:
  virtual ~Camera() = default;

  /// The ray through a film position and, for lenses, a point of the unit square on the aperture.
  /// It starts on the near and ends on the far clipping plane; its direction has unit length. Every
  /// ray carries the same weight.
  virtual Ray sample_ray(const Point2f& film, const Point2f& lens) const = 0;

  /// Whether `lens` matters.
  virtual bool has_lens() const { return false; }
};

}  // namespace duet
