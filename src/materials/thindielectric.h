// A thin pane of glass: light is reflected or passes straight through.
#pragma once

#include "materials/dielectric.h"

namespace duet {

/// Two parallel interfaces as one, with all reflections between them: R' = R + T² R + T² R³ + … =
/// 2 R / (1 + R). The transmitted light counts as if there were no surface.
struct ThinDielectricModel {
  float eta;
  Spectrum specular_reflectance, specular_transmittance;

  bool has_smooth() const { return false; }
  bool has_delta() const { return true; }
  bool needs_choice() const { return true; }

  ModelEval eval(const Vector3f&, const Vector3f&, Transport) const { return {}; }

  /// The share of the light that passes.
  Spectrum straight_through(const Vector3f& wo) const {
    const float once = fresnel_dielectric(std::abs(wo.z), eta).reflectance;
    return specular_transmittance * (1 - 2 * once / (1 + once));
  }

  [[gnu::always_inline]] BranchFreeSample sample_branch_free(const Vector3f& wo, float u,
                                                             const Point2f&, Transport) const {
    const float once = fresnel_dielectric(std::abs(wo.z), eta).reflectance;
    const float f = 2 * once / (1 + once);
    const float p = reflection_probability(f, specular_reflectance, specular_transmittance);
    const bool reflects = u < p;
    const float share = reflects ? f / p : (1 - f) / (1 - p);
    BranchFreeSample s;
    s.wi = Vector3f(-wo.x, -wo.y, reflects ? wo.z : -wo.z);
    s.weight = colour_of(reflects, specular_reflectance, specular_transmittance) * share;
    s.pdf = reflects ? p : 1 - p;
    s.delta = 1;
    const int32_t passes = f < 1 ? 1 : 0;
    s.carries = wo.z != 0 ? (reflects ? 1 : passes) : 0;
    s.null = reflects ? 0 : 1;
    return s;
  }
  std::optional<ModelSample> sample(const Vector3f& wo, float u, const Point2f& v,
                                    Transport transport) const {
    return sample_branch_free(wo, u, v, transport).model_sample();
  }
};

}  // namespace duet
