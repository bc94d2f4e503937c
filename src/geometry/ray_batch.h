// Rays that are asked for together.
#pragma once

#include "math/batch.h"

namespace duet {

struct RayBatch {
  BatchTriples origin, direction;
  BatchArray<float> tmax;

  Ray operator[](int i) const { return {origin.point(i), direction.vector(i), tmax[i]}; }
};

/// Where rays have met the scene: `shape` is kNone for those that have met nothing. See Hit.
struct HitBatch {
  BatchArray<float> t, u, v;
  BatchArray<uint32_t> primitive, shape, instance;
};

}  // namespace duet
