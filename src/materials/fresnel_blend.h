// A diffuse base under a glossy coat.
#pragma once

#include "materials/microfacet.h"
#include "materials/model.h"

namespace duet {

/// What the coat does not reflect gets to the base, and is reduced in both directions. Facets have
/// the distribution D of the model, but no masking. Zero below the surface.
/// Source: Ashikhmin & Shirley, "An Anisotropic Phong BRDF Model", 2000, in the form for any
/// distribution of Pharr, Jakob, Humphreys, "Physically Based Rendering", 3rd ed., 2016, section
/// 8.5.
struct FresnelBlendModel {
  Spectrum diffuse, specular;  ///< of the base, and of the coat along the normal
  Microfacet microfacet;

  bool has_smooth() const { return true; }
  bool has_delta() const { return false; }
  bool needs_choice() const { return specular_probability() < 1; }
  float nearly_specular_share() const;

  ModelEval eval(const Vector3f& wo, const Vector3f& wi, Transport) const;
  std::optional<ModelSample> sample(const Vector3f& wo, float u, const Point2f& v,
                                    Transport transport) const;

 private:
  /// The coat is a mirror near the horizon, whatever its colour.
  float specular_probability() const { return diffuse.is_black() ? 1.0f : 0.5f; }
};

}  // namespace duet
