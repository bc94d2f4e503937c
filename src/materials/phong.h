// A diffuse base with a glossy lobe around the direction of reflection.
#pragma once

#include "materials/microfacet_kind.h"
#include "materials/model.h"

namespace duet {

/// f = ρd / π + ρs (n + 2) / 2π · cosⁿ α on the upper side, where α is the angle between wi and the
/// mirror image of wo.
/// Source: Lafortune & Willems, "Using the Modified Phong Reflectance Model for Physically Based
/// Rendering", 1994.
struct PhongModel {
  Spectrum diffuse, specular;
  float exponent;              ///< n ≥ 0
  float specular_probability;  ///< of sampling the lobe

  bool has_smooth() const { return !(diffuse.is_black() && specular.is_black()); }
  bool has_delta() const { return false; }
  bool needs_choice() const { return specular_probability > 0 && specular_probability < 1; }
  /// The lobe is as dense at its peak, (n + 1) / 2π, as one of facets with 2 (n + 1) α² = 1.
  float nearly_specular_share() const {
    const bool sharp = 2 * (exponent + 1) * float(sqr(kNearlySpecular)) > 1;
    return sharp ? specular_probability : 0.0f;
  }

  ModelEval eval(const Vector3f& wo, const Vector3f& wi, Transport) const;
  std::optional<ModelSample> sample(const Vector3f& wo, float u, const Point2f& v,
                                    Transport transport) const;
};

}  // namespace duet
