// Direct illumination only.
#pragma once

#include "integrators/camera_integrator.h"

namespace duet {

struct DirectOptions {
  int emitter_samples = 1, bsdf_samples = 1;  ///< at the first hit; either may be 0
  bool hide_emitters = false;
  bool strict_normals = false;
};

/// Emission seen directly and light that was scattered once, with several samples of each strategy.
class DirectIntegrator final : public CameraIntegrator {
 public:
  DirectIntegrator(const DirectOptions& options, const CameraOutput& output)
      : CameraIntegrator(output), options_(options) {}

 protected:
  Spectrum radiance(const Scene& scene, const CameraPath& start, Sampler& sampler,
                    RenderCounters& counters, std::span<float> values) const override;

 private:
  DirectOptions options_;
};

}  // namespace duet
