// Where rays meet ribbons, by pbrt's definition: a ribbon faces each ray, so a ray meets it where
// the curve, seen along the ray, is within the ribbon's radius.
#pragma once

#include "geometry/shape.h"

namespace duet {

/// Into how many parts a segment is divided to be found by rays: those of pbrt, which divides each
/// of them further until it is nearly straight. Wide ribbons show where that was.
inline constexpr uint32_t kRibbonParts = 8;

struct RibbonHit {
  float t;  ///< where the ray is level with the curve
  float u;  ///< along the segment
};

/// The nearest hit in (tnear, ray.tmax) of a part: those of a segment follow one another. False if
/// there is none.
bool intersect_ribbon(const CurveSet& curves, uint32_t part, const Ray& ray, float tnear,
                      RibbonHit& hit);

/// A box around all points of rays at which they meet the part.
Bounds ribbon_bounds(const CurveSet& curves, uint32_t part);

}  // namespace duet
