// How much of the space above the first surface is free: Mitsuba 0.6's ambient occlusion.
#pragma once

#include "integrators/camera_integrator.h"
#include "math/warp.h"

namespace duet {

/// The share of directions, weighted by the cosine, in which nothing is nearer than a length; one
/// where the camera sees nothing, unless that is to be black. No light and no material counts, and
/// surfaces are looked at from the side of their normal. Source: Zhukov, Iones & Kronin, "An
/// Ambient Light Illumination Model", 1998.
class OcclusionIntegrator final : public CameraIntegrator {
 public:
  OcclusionIntegrator(const OcclusionIntegratorDescription& options, const CameraOutput& output)
      : CameraIntegrator(output), options_(options) {}

 protected:
  Spectrum radiance(const Scene& scene, const CameraPath& start, Sampler& sampler,
                    RenderCounters& counters, std::span<float> values) const override {
    Hit hit;
    ++counters.closest_rays;
    if (!scene.accel->closest_hit(start.ray, hit))
      return Spectrum(options_.background ? 1.0f : 0.0f);
    values[3] = 1;
    ++counters.path_vertices;
    const Surface s = scene.surface(start.ray, hit);
    const float length = options_.ray_length > 0 ? float(options_.ray_length)
                                                 : 0.5f * scene.features.bounds.radius();
    int free = 0;
    for (int i = 0; i < options_.shading_samples; ++i) {
      sampler.start_dimension(kFirstVertexDimension + 2 * uint32_t(i));
      Ray ray = spawn_ray(s, s.shading.to_world(square_to_cosine_hemisphere(sampler.next_2d())));
      ray.tmax = length;
      ++counters.shadow_rays;
      free += !scene.accel->occluded(ray);
    }
    return Spectrum(float(free) / float(options_.shading_samples));
  }

 private:
  OcclusionIntegratorDescription options_;
};

}  // namespace duet
