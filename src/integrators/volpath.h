// Path tracing through participating media.
#pragma once

#include "integrators/camera_integrator.h"
#include "scene/description_integrators.h"
#include "transport/roulette.h"

namespace duet {

/// Unidirectional path tracing with media: light is found by light samples, whose shadow rays pass
/// media and surfaces that let light straight through, and by what scattering samples. Chromatic
/// extinction is handled by spectral MIS (SpectralWeights). What passes
/// straight through a surface does not lengthen the path.
/// Source: Miller, Georgiev & Jarosz 2019.
class VolumePathIntegrator final : public CameraIntegrator {
 public:
  VolumePathIntegrator(const PathLimits& options, const CameraOutput& output)
      : CameraIntegrator(output), options_(options) {}

 protected:
  Spectrum radiance(const Scene& scene, const CameraPath& start, Sampler& sampler,
                    RenderCounters& counters, std::span<float> values) const override;

 private:
  struct Path;
  /// The distance to where the medium that the ray is in scatters it, or INFINITY. Random numbers
  /// begin at `dimension`.
  float cross_medium(bool found, const Hit& hit, uint32_t dimension, Path& path) const;
  /// Adds the light of the surface and scatters; false if the path ends.
  bool meet_surface(const Scene& scene, const Hit& hit, uint32_t dimension, Path& path) const;
  /// Light is scattered at a point of the medium; false if the path ends.
  bool scatter_in_medium(const Scene& scene, const Point3f& p, uint32_t dimension,
                         Path& path) const;
  /// The same at a surface. `B` is Bsdf or PlainDiffuse.
  template <class B>
  bool scatter_at_surface(const Scene& scene, const Surface& s, const B& bsdf, uint32_t dimension,
                          Path& path) const;
  /// Whether the path goes on; its weight then makes up for those that end.
  bool survives(Path& path, const Roulette& roulette) const;
  /// Whether the next point of scattering would be one too many.
  bool at_limit(int depth) const { return options_.max_depth >= 0 && depth >= options_.max_depth; }

  /// Whether lights that are met now are not to be seen.
  bool hides_lights(int depth) const { return depth == 0 && options_.hide_emitters; }

  PathLimits options_;
};

}  // namespace duet
