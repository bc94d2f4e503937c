// Interfaces between transparent media: reflection and refraction, smooth and rough.
//
// `eta` is the index of the inside (below the surface) over that of the outside.
#pragma once

#include "materials/fresnel.h"
#include "materials/microfacet.h"
#include "materials/model.h"

namespace duet {

/// The probability with which the reflected one of two lobes is sampled that carry the shares F and
/// 1 − F of the light, given what their colours leave of it. Zero if both are black.
[[gnu::always_inline]] inline float reflection_probability(float f, const Spectrum& reflectance,
                                                           const Spectrum& transmittance) {
  const float r = f * reflectance.mean(), t = (1 - f) * transmittance.mean();
  const float p = r / (r + t);
  return r + t > 0 ? p : 0.0f;
}

/// The colour of the lobe that was chosen, without branches.
[[gnu::always_inline]] inline Spectrum colour_of(bool reflects, const Spectrum& reflectance,
                                                 const Spectrum& transmittance) {
  return {reflects ? reflectance.r : transmittance.r, reflects ? reflectance.g : transmittance.g,
          reflects ? reflectance.b : transmittance.b};
}

/// How much radiance is compressed by passing into a medium of relative index `eta`.
[[gnu::always_inline]] inline float compression(float eta, Transport transport) {
  return transport == Transport::radiance ? 1 / (eta * eta) : 1.0f;
}

/// A smooth interface: two delta lobes.
struct DielectricModel {
  float eta;
  Spectrum specular_reflectance, specular_transmittance;

  bool has_smooth() const { return false; }
  bool has_delta() const { return true; }
  bool needs_choice() const { return true; }

  ModelEval eval(const Vector3f&, const Vector3f&, Transport) const { return {}; }
  [[gnu::always_inline]] BranchFreeSample sample_branch_free(const Vector3f& wo, float u,
                                                             const Point2f&,
                                                             Transport transport) const {
    const bool below = wo.z < 0;
    const float relative = below ? 1 / eta : eta;
    const DielectricFresnel f = fresnel_dielectric(std::abs(wo.z), relative);
    const float p =
        reflection_probability(f.reflectance, specular_reflectance, specular_transmittance);
    const bool reflects = u < p;
    const float transmitted = 1 - f.reflectance;
    const float share =
        reflects ? f.reflectance / p : transmitted / (1 - p) * compression(relative, transport);
    const int32_t black = specular_transmittance.is_black() ? 1 : 0;
    const int32_t passes = std::min(transmitted, f.cos_t) > 0 ? 1 - black : 0;
    const float down = below ? f.cos_t : -f.cos_t;
    BranchFreeSample s;
    s.wi = Vector3f(reflects ? -wo.x : -wo.x / relative, reflects ? -wo.y : -wo.y / relative,
                    reflects ? wo.z : down);
    s.weight = colour_of(reflects, specular_reflectance, specular_transmittance) * share;
    s.pdf = reflects ? p : 1 - p;
    s.delta = 1;
    s.eta = reflects ? 1.0f : relative;
    s.carries = wo.z != 0 ? (reflects ? 1 : passes) : 0;
    return s;
  }
  std::optional<ModelSample> sample(const Vector3f& wo, float u, const Point2f& v,
                                    Transport transport) const {
    return sample_branch_free(wo, u, v, transport).model_sample();
  }
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
  /// Both for eta ≠ 1 without branches, for loops over many points, too. Of the facets they ask
  /// Microfacet::core() and sample().
  template <class Facets>
  [[gnu::always_inline]] ModelEval eval_by(const Facets& facets, const Vector3f& wo,
                                           const Vector3f& wi, Transport transport) const;
  template <class Facets>
  [[gnu::always_inline]] BranchFreeSample sample_by(const Facets& facets, const Vector3f& wo,
                                                    float u, const Point2f& v,
                                                    Transport transport) const;
};

template <class Facets>
inline ModelEval RoughDielectricModel::eval_by(const Facets& facets, const Vector3f& wo,
                                               const Vector3f& wi, Transport transport) const {
  const bool below = wo.z < 0;
  const float relative = below ? 1 / eta : eta;
  const Vector3f o = mirrored(wo, below), i = mirrored(wi, below);
  const bool reflects = i.z > 0;
  const Vector3f half = normalize(o + i * (reflects ? 1.0f : relative));
  const Vector3f h = half * (half.z < 0 ? -1.0f : 1.0f);
  const float oh = dot(o, h), ih = dot(i, h);
  const Microfacet::Core core = facets.core(o, i, h);
  const float f = dielectric_reflectance(oh, relative);
  const float p = reflection_probability(f, specular_reflectance, specular_transmittance);
  // Solid angle of h per solid angle of wi, over |i·h| (eq. 17).
  const float jacobian = sqr(relative / (oh + relative * ih)) * oh * -ih;
  const float value = reflects ? 0.25f * f * core.value
                               : (1 - f) * core.value * jacobian * compression(relative, transport);
  const float pdf = reflects ? 0.25f * p * core.density : (1 - p) * core.density * jacobian;
  // A facet must be seen from the same side as the surface.
  const float seen = std::min(std::min(h.z, oh), reflects ? ih : -ih);
  const float cosine = std::min(std::abs(wo.z), std::abs(wi.z));
  const bool scatters = std::min(seen, cosine - kMinCosine) > 0;
  const float scale = scatters ? value : 0.0f;
  return {colour_of(reflects, specular_reflectance, specular_transmittance) * scale,
          scatters ? pdf : 0.0f};
}

template <class Facets>
inline BranchFreeSample RoughDielectricModel::sample_by(const Facets& facets, const Vector3f& wo,
                                                        float u, const Point2f& v,
                                                        Transport transport) const {
  const bool below = wo.z < 0;
  const float relative = below ? 1 / eta : eta;
  const Vector3f o = mirrored(wo, below);
  const Vector3f m = facets.sample(o, v);
  const float om = dot(o, m);
  const DielectricFresnel f = fresnel_dielectric(om, relative);
  const float p =
      reflection_probability(f.reflectance, specular_reflectance, specular_transmittance);
  const bool reflects = u < p;
  const float along = reflects ? 2 * om : om / relative - f.cos_t;
  const Vector3f i = m * along - o * (reflects ? 1.0f : 1 / relative);
  const float im = dot(i, m);
  const Microfacet::Core core = facets.core(o, i, m);
  const float transmitted = 1 - f.reflectance, ratio = core.value / core.density;
  const float jacobian = sqr(relative / (om + relative * im)) * om * -im;
  const float weight = reflects ? ratio * f.reflectance / p
                                : ratio * transmitted / (1 - p) * compression(relative, transport);
  BranchFreeSample s;
  s.wi = mirrored(i, below);
  s.weight = colour_of(reflects, specular_reflectance, specular_transmittance) * weight;
  s.pdf = reflects ? 0.25f * p * core.density : (1 - p) * core.density * jacobian;
  s.eta = reflects ? 1.0f : relative;
  // What is not a number comes first, or it would be lost.
  const float seen = std::min(std::min(std::min(s.pdf, core.density), m.z), om);
  const float passes = reflects ? 1.0f : std::min(transmitted, -im);
  const float cosine = std::min(std::abs(wo.z), reflects ? i.z : -i.z);
  s.carries = std::min(std::min(seen, passes), cosine - kMinCosine) > 0 ? 1 : 0;
  return s;
}

}  // namespace duet
