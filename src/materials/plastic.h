// A diffuse base under a clear dielectric coat, smooth or rough.
//
// Light that enters is scattered by the base and partly reflected back onto it by the coat; the sum
// of these reflections is part of the base's reflectance.
#pragma once

#include "materials/fresnel.h"
#include "materials/microfacet.h"
#include "materials/model.h"
#include "materials/rough_transmittance.h"
#include "math/warp.h"

namespace duet {

/// The base as seen through the coat: ρ / ((1 − ρ' R) η²), where R is the coat's diffuse
/// reflectance from inside. ρ' is ρ itself if colours may be shifted by the reflections between
/// coat and base
/// (`nonlinear`), or else 1. What is left out is the transmittance of the coat in both directions.
[[gnu::always_inline]] inline Spectrum coated_reflectance(const Spectrum& base,
                                                          float internal_reflectance, float eta,
                                                          bool nonlinear) {
  // A base that reflects more than it receives would otherwise end in a series without a sum.
  const float by_base = nonlinear ? internal_reflectance : 0.0f,
              by_all = nonlinear ? 0.0f : internal_reflectance;
  const auto coated = [&](float b) {
    const float lost = 1 - (b * by_base + by_all);
    return b / (std::max(lost, 1e-3f) * eta * eta);
  };
  return {coated(base.r), coated(base.g), coated(base.b)};
}

/// Probability of the specular lobe, of which the coat reflects the share `f`.
[[gnu::always_inline]] inline float lobe_probability(float f, float specular_weight,
                                                     float diffuse_weight) {
  const float s = f * specular_weight, d = (1 - f) * diffuse_weight;
  return s + d > 0 ? s / (s + d) : 0.0f;
}

/// A smooth coat: a delta lobe and the base. `eta` is the coat's index over the outside's.
struct PlasticModel {
  float eta;
  Spectrum specular_reflectance;
  Spectrum coated_base;  ///< coated_reflectance()
  float specular_weight,
      diffuse_weight;  ///< what the two lobes reflect of the light that meets them

  bool has_smooth() const { return diffuse_weight > 0; }
  bool has_delta() const { return specular_weight > 0; }
  bool needs_choice() const { return has_smooth() && has_delta(); }

  ModelEval eval(const Vector3f& wo, const Vector3f& wi, Transport) const {
    return wo.z > 0 && wi.z > 0 ? eval_above(wo, wi) : ModelEval{};
  }
  std::optional<ModelSample> sample(const Vector3f& wo, float u, const Point2f& v,
                                    Transport transport) const {
    return sample_branch_free(wo, u, v, transport).model_sample();
  }
  /// eval() of directions above the horizon. Without branches, for loops over many points, too.
  [[gnu::always_inline]] ModelEval eval_above(const Vector3f& wo, const Vector3f& wi) const {
    const float fo = fresnel_dielectric(wo.z, eta).reflectance;
    const float fi = fresnel_dielectric(wi.z, eta).reflectance;
    const float cosine = wi.z * kInvPi;
    return {coated_base * (cosine * (1 - fo) * (1 - fi)),
            cosine * (1 - lobe_probability(fo, specular_weight, diffuse_weight))};
  }
  /// The factor of what the base scatters by which it depends on the direction it is seen from.
  [[gnu::always_inline]] float seen_through_coat(float cosine) const {
    return 1 - fresnel_dielectric(cosine, eta).reflectance;
  }
  [[gnu::always_inline]] BranchFreeSample sample_branch_free(const Vector3f& wo, float u,
                                                             const Point2f& v, Transport) const {
    const float fo = fresnel_dielectric(wo.z, eta).reflectance;
    const float p = lobe_probability(fo, specular_weight, diffuse_weight);
    const bool reflects = u < p;
    const Vector3f diffuse = square_to_cosine_hemisphere(v);
    const float fi = fresnel_dielectric(diffuse.z, eta).reflectance;
    const Spectrum mirrored = specular_reflectance * (fo / p);
    const Spectrum scattered = coated_base * ((1 - fo) * (1 - fi) / (1 - p));
    BranchFreeSample s;
    s.wi = Vector3f(reflects ? -wo.x : diffuse.x, reflects ? -wo.y : diffuse.y,
                    reflects ? wo.z : diffuse.z);
    s.weight = {reflects ? mirrored.r : scattered.r, reflects ? mirrored.g : scattered.g,
                reflects ? mirrored.b : scattered.b};
    s.pdf = reflects ? p : (1 - p) * diffuse.z * kInvPi;
    s.delta = reflects ? 1 : 0;
    const int32_t enters = std::min(diffuse.z, 1 - p) > 0 ? 1 : 0;
    s.carries = wo.z > 0 ? (reflects ? 1 : enters) : 0;
    return s;
  }
};

/// A smooth plastic of which only the base differs from point to point.
struct UniformPlastic {
  float eta;
  Spectrum specular_reflectance;
  float internal_reflectance;
  bool nonlinear;

  [[gnu::always_inline]] PlasticModel model(const Spectrum& base) const {
    return {eta, specular_reflectance,
            coated_reflectance(base, internal_reflectance, eta, nonlinear),
            specular_reflectance.mean(), base.mean()};
  }
};

/// A rough coat: reflection off microfacets and the base.
struct RoughPlasticModel {
  Microfacet microfacet;
  float eta;
  Spectrum specular_reflectance;
  Spectrum coated_base;
  float specular_weight, diffuse_weight;
  TransmittanceRow transmittance;

  bool has_smooth() const { return specular_weight + diffuse_weight > 0; }
  bool has_delta() const { return false; }
  bool needs_choice() const { return specular_weight > 0 && diffuse_weight > 0; }
  float nearly_specular_share() const;

  ModelEval eval(const Vector3f& wo, const Vector3f& wi, Transport) const;
  std::optional<ModelSample> sample(const Vector3f& wo, float u, const Point2f& v, Transport) const;
  /// eval() of directions above the horizon, where the facets reflect `r`, of which the coat has
  /// the reflectance `f`. Without branches, for loops over many points, too.
  [[gnu::always_inline]] ModelEval eval_above(const Vector3f& wo, const Vector3f& wi,
                                              const Microfacet::Reflection& r, float f) const {
    const float to = transmittance(wo.z), ti = transmittance(wi.z);
    const float p = specular_probability(to);
    const float cosine = wi.z * kInvPi;
    return {specular_reflectance * (f * r.value) + coated_base * (cosine * to * ti),
            p * r.density + (1 - p) * cosine};
  }
  /// See PlasticModel.
  [[gnu::always_inline]] float seen_through_coat(float cosine) const {
    return transmittance(cosine);
  }
  [[gnu::always_inline]] float specular_probability(float transmitted) const {
    return lobe_probability(1 - transmitted, specular_weight, diffuse_weight);
  }
};

/// A rough plastic of which only the base differs from point to point.
struct UniformRoughPlastic {
  Microfacet microfacet;
  float eta;
  Spectrum specular_reflectance;
  TransmittanceRow transmittance;
  float internal_reflectance;
  bool nonlinear;

  [[gnu::always_inline]] RoughPlasticModel model(const Spectrum& base) const {
    return {microfacet,
            eta,
            specular_reflectance,
            coated_reflectance(base, internal_reflectance, eta, nonlinear),
            specular_reflectance.mean(),
            base.mean(),
            transmittance};
  }
};

}  // namespace duet
