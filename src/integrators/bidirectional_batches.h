// Sub-paths of the methods that trace them from both ends, in batches.
#pragma once

#include "integrators/bidirectional.h"
#include "integrators/wide_eye.h"
#include "integrators/wide_light_walk.h"
#include "integrators/wide_tiles.h"

namespace duet {

/// What the batches of all iterations have in common.
struct BidirectionalIntegrator::Batches {
  Batches(const Scene& s, WideUse use) : scene(s, use), lights(scene) {}

  void begin_eye(const CameraIntegrator& method, const PathLimits& limits) {
    eye.emplace(scene.scene, method,
                [this, limits] { return std::make_unique<WideEye>(scene, limits, plan); });
  }

  WideScene scene;
  WideLightTracer lights;
  WideEyePlan plan;
  std::optional<WideTiles> eye;  ///< empty if eye sub-paths are traced one by one
};

}  // namespace duet
