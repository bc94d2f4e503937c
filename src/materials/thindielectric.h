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

  std::optional<ModelSample> sample(const Vector3f& wo, float u, const Point2f&, Transport) const {
    if (wo.z == 0) return std::nullopt;
    const float once = fresnel_dielectric(std::abs(wo.z), eta).reflectance;
    const float r = 2 * once / (1 + once);
    const float p = reflection_probability(r, specular_reflectance, specular_transmittance);
    if (u < p)
      return ModelSample{
          .wi = reflect(wo), .weight = specular_reflectance * (r / p), .pdf = p, .delta = true};
    if (!(r < 1)) return std::nullopt;
    return ModelSample{.wi = -wo,
                       .weight = specular_transmittance * ((1 - r) / (1 - p)),
                       .pdf = 1 - p,
                       .delta = true,
                       .null = true};
  }
};

}  // namespace duet
