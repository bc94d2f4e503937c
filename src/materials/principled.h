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
/// factor. Without branches: for loops over many points, too.
[[gnu::always_inline]] inline float principled_diffuse(float cos_o, float cos_i, float cos_d,
                                                       float roughness, float flatness) {
  const float fo = schlick_weight(cos_o), fi = schlick_weight(cos_i);
  const float rr = 2 * roughness * cos_d * cos_d;
  const float base = (1 - 0.5f * fo) * (1 - 0.5f * fi);
  const float retro = rr * (fo + fi + fo * fi * (rr - 1));
  const float fss90 = 0.5f * rr;
  const float fss = lerp(1.0f, fss90, fo) * lerp(1.0f, fss90, fi);
  const float subsurface = 1.25f * (fss * (1 / (cos_o + cos_i) - 0.5f) + 0.5f);
  return lerp(base + retro, subsurface, flatness);
}

inline float clamped_to_unit(float x) {
  return std::clamp(x, 0.0f, 1.0f);
}

/// A colour scaled to luminance one; white for black.
[[gnu::always_inline]] inline Spectrum tint_of(const Spectrum& color) {
  const float l = color.luminance();
  const Spectrum tint = color / l;
  return {l > 0 ? tint.r : 1, l > 0 ? tint.g : 1, l > 0 ? tint.b : 1};
}

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

  /// Probabilities of the lobes seen from above, whatever the half vector.
  struct Choice {
    float diffuse, clearcoat, specular;
  };
  Choice choice() const;
  /// Reflection from `o` to `i`, both above, by all lobes but the clear coat; `r` is that of the
  /// facets. Without branches: for loops over many points, too.
  ModelEval eval_uncoated(const Vector3f& o, const Vector3f& i, const Microfacet::Reflection& r,
                          const Choice& pick) const;

 private:
  float brdf() const { return (1 - metallic) * (1 - spec_trans); }
  float bsdf() const { return (1 - metallic) * spec_trans; }
  Spectrum front_fresnel(float dielectric, float cosine) const;
  float clearcoat_density(float cosine) const {
    return clearcoat_scale / (1 + (clearcoat_alpha2 - 1) * cosine * cosine);
  }
  ModelEval eval_front(const Vector3f& o, const Vector3f& i) const;
};

/// Metals and tinted reflections follow Schlick, the rest the exact equations.
[[gnu::always_inline]] inline Spectrum PrincipledModel::front_fresnel(float dielectric,
                                                                      float cosine) const {
  const float w = schlick_weight(cosine, eta);
  return Spectrum((1 - metallic) * (1 - spec_tint) * dielectric) +
         lerp(base_color, Spectrum(1), w) * metallic +
         lerp(tint * normal_reflectance(eta), Spectrum(1), w) * ((1 - metallic) * spec_tint);
}

[[gnu::always_inline]] inline ModelEval PrincipledModel::eval_uncoated(
    const Vector3f& o, const Vector3f& i, const Microfacet::Reflection& r,
    const Choice& pick) const {
  const float f = fresnel_dielectric(r.cosine, eta).reflectance;
  const float diffuse =
      brdf() * i.z * kInvPi * principled_diffuse(o.z, i.z, r.cosine, roughness, flatness);
  const float along = sheen * (1 - metallic) * schlick_weight(r.cosine) * i.z;
  return {front_fresnel(f, r.cosine) * (f > 0 ? r.value : 0.0f) + base_color * diffuse +
              lerp(Spectrum(1), tint, sheen_tint) * along,
          pick.specular * (1 - bsdf() * (1 - f)) * r.density + pick.diffuse * i.z * kInvPi};
}

}  // namespace duet
