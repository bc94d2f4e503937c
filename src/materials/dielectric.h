// Interfaces between transparent media: reflection and refraction, smooth and rough.
//
// `eta` is the index of the inside (below the surface) over that of the outside.
#pragma once

#include "materials/fresnel.h"
#include "materials/microfacet.h"
#include "materials/model.h"

namespace duet {

/// A smooth interface: two delta lobes.
struct DielectricModel {
  float eta;
  Spectrum specular_reflectance, specular_transmittance;

  bool has_smooth() const { return false; }
  bool has_delta() const { return true; }
  bool needs_choice() const { return true; }

  ModelEval eval(const Vector3f&, const Vector3f&, Transport) const { return {}; }
  std::optional<ModelSample> sample(const Vector3f& wo, float u, const Point2f&,
                                    Transport transport) const;
};

/// A rough interface: single reflection and refraction at microfacets. With eta = 1 the facets do
/// nothing and light passes straight.
/// Source: Walter et al., "Microfacet Models for Refraction through Rough Surfaces", 2007, eq.
/// 20, 21.
struct RoughDielectricModel {
  Microfacet microfacet;
  float eta;
  Spectrum specular_reflectance, specular_transmittance;

  bool has_smooth() const { return eta != 1; }
  bool has_delta() const { return eta == 1; }
  bool needs_choice() const { return eta != 1; }
  float nearly_specular_share() const { return microfacet.is_nearly_specular() ? 1.0f : 0.0f; }

  ModelEval eval(const Vector3f& wo, const Vector3f& wi, Transport transport) const;
  std::optional<ModelSample> sample(const Vector3f& wo, float u, const Point2f& v,
                                    Transport transport) const;
};

/// The probability with which the reflected one of two lobes is sampled that carry the shares F and
/// 1 − F of the light, given what their colours leave of it. Zero if both are black.
inline float reflection_probability(float f, const Spectrum& reflectance,
                                    const Spectrum& transmittance) {
  const float r = f * reflectance.mean(), t = (1 - f) * transmittance.mean();
  return r + t > 0 ? r / (r + t) : 0.0f;
}

}  // namespace duet
