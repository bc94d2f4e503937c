// The distance to the first surface.
#pragma once

#include "integrators/camera_integrator.h"

namespace duet {

/// Distance along the camera's ray, the same in all three channels; zero where nothing is seen.
class DepthIntegrator final : public CameraIntegrator {
 public:
  explicit DepthIntegrator(const CameraOutput& output) : CameraIntegrator(output) {}

 protected:
  Spectrum radiance(const Scene& scene, const CameraPath& start, Sampler&, RenderCounters& counters,
                    std::span<float> values) const override {
    Hit hit;
    ++counters.closest_rays;
    if (!scene.accel->closest_hit(start.ray, hit)) return {};
    values[3] = 1;
    return Spectrum(hit.t);
  }
};

}  // namespace duet
