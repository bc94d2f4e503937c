// Burley's "principled" material with reflection and refraction, as parametrised by Mitsuba 3.
//
// Sources: Burley, "Physically Based Shading at Disney", 2012; Burley, "Extending the Disney BRDF
// to a BSDF with Integrated Subsurface Scattering", 2015.
#pragma once

#include <algorithm>

#include "materials/fresnel.h"
#include "materials/microfacet.h"
#include "materials/model.h"

namespace duet {

/// Burley's roughness and anisotropy as a GGX distribution.
Microfacet principled_facets(float roughness, float anisotropic);

/// Retro-reflective diffuse lobe over albedo, flattened towards an approximation of subsurface
/// scattering; `cos_d` is the cosine between a direction and the half vector. Without cosine
/// factor.
float principled_diffuse(float cos_o, float cos_i, float cos_d, float roughness, float flatness);

inline float clamped_to_unit(float x) {
  return std::clamp(x, 0.0f, 1.0f);
}

/// A colour scaled to luminance one; white for black.
Spectrum tint_of(const Spectrum& color);

/// A diffuse base with sheen, a main specular lobe that blends metal, plastic and rough glass, and
/// a clear coat. Only the glass is seen from below. All weights lie in [0, 1].
struct PrincipledModel {
  Microfacet facets;
  Spectrum base_color, tint;
  float roughness, metallic, spec_trans, eta, spec_tint;
  float sheen, sheen_tint, flatness;
  float clearcoat, clearcoat_alpha2;
  /// (α² − 1) / (π ln α²), the scale of the clear coat's distribution.
  float clearcoat_scale;
  /// How often the lobes are sampled, relative to what they usually reflect.
  float diffuse_rate, specular_rate, clearcoat_rate;

  bool has_smooth() const { return true; }
  bool has_delta() const { return false; }
  bool needs_choice() const { return true; }
  float nearly_specular_share() const;

  ModelEval eval(const Vector3f& wo, const Vector3f& wi, Transport transport) const;
  std::optional<ModelSample> sample(const Vector3f& wo, float u, const Point2f& v,
                                    Transport transport) const;

 private:
  float brdf() const { return (1 - metallic) * (1 - spec_trans); }
  float bsdf() const { return (1 - metallic) * spec_trans; }
  /// Probabilities of the lobes seen from above, whatever the half vector.
  struct Choice {
    float diffuse, clearcoat, specular;
  };
  Choice choice() const;
  Spectrum front_fresnel(float dielectric, float cosine) const;
  float clearcoat_density(const Vector3f& m) const {
    return clearcoat_scale / (1 + (clearcoat_alpha2 - 1) * m.z * m.z);
  }
  ModelEval eval_front(const Vector3f& o, const Vector3f& i, const Vector3f& h, float f,
                       const Microfacet::Core& core) const;
};

}  // namespace duet
