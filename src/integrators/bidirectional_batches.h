// Eye sub-paths of bidirectional path tracing in batches.
#pragma once

#include "integrators/bidirectional.h"
#include "integrators/wide_eye.h"
#include "integrators/wide_tiles.h"

namespace duet {

/// What the batches of all iterations have in common.
struct BidirectionalIntegrator::Batches {
  Batches(const Scene& s, const PathLimits& limits, bool merges)
      : scene(s, merges), tiles(*s.camera, [this, limits] {
          return std::make_unique<WideEye>(scene, limits, plan);
        }) {}

  WideScene scene;
  WideEyePlan plan;
  WideTiles tiles;
};

}  // namespace duet
