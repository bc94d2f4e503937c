// A diffuse base under a clear dielectric coat, smooth or rough.
//
// Light that enters is scattered by the base and partly reflected back onto it by the coat; the sum
// of these reflections is part of the base's reflectance.
#pragma once

#include "materials/fresnel.h"
#include "materials/microfacet.h"
#include "materials/model.h"
#include "materials/rough_transmittance.h"

namespace duet {

/// The base as seen through the coat: ρ / ((1 − ρ' R) η²), where R is the coat's diffuse
/// reflectance from inside. ρ' is ρ itself if colours may be shifted by the reflections between
/// coat and base
/// (`nonlinear`), or else 1. What is left out is the transmittance of the coat in both directions.
Spectrum coated_reflectance(const Spectrum& base, float internal_reflectance, float eta,
                            bool nonlinear);

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

  ModelEval eval(const Vector3f& wo, const Vector3f& wi, Transport) const;
  std::optional<ModelSample> sample(const Vector3f& wo, float u, const Point2f& v, Transport) const;
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

 private:
  float specular_probability(float transmitted) const;
};

}  // namespace duet
