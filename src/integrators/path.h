// Path tracing with next event estimation.
#pragma once

#include "integrators/camera_integrator.h"
#include "scene/description_integrators.h"

namespace duet {

/// Unidirectional path tracing from the camera. Light is found by light samples and by BSDF
/// samples, weighted by the power heuristic (Veach 1997, section 9.2.4). With groups of pixels
/// paths use one another's second vertices (wide_pixel_groups.h).
class PathIntegrator final : public CameraIntegrator {
 public:
  PathIntegrator(const PathIntegratorDescription& options, const CameraOutput& output,
                 PathBatches batches = PathBatches::where_possible)
      : CameraIntegrator(output), options_(options), batches_(batches) {}

  /// Whether paths of the scene can be traced in groups of pixels.
  static bool suits_groups(const Scene& scene);

 protected:
  void choose(const Scene& scene, const RenderOutlook& outlook) override;
  void render_samples(const Scene& scene, Film& film, const SampleRange& samples,
                      const PassControl& control, RenderCounters& counters) override;
  Spectrum radiance(const Scene& scene, const CameraPath& start, Sampler& sampler,
                    RenderCounters& counters, std::span<float> values) const override;

 private:
  struct Path;
  /// Adds light that comes straight from a light to a vertex of the path, and chooses where the
  /// path goes on; false if it ends. `B` is Bsdf or PlainDiffuse.
  template <class B>
  bool scatter(const Scene& scene, const Surface& s, const B& bsdf, int depth, Path& path) const;

  bool takes_batches(const Scene& scene) const;

  PathIntegratorDescription options_;
  PathBatches batches_;
};

}  // namespace duet
