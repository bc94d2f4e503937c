// A diffuse base under a dielectric coat with an absorbing layer between them, in closed form.
#pragma once

#include "materials/coat_transmittance.h"
#include "materials/fresnel.h"
#include "materials/model.h"

namespace duet {

/// What a diffuse base of reflectance ρ under a coat gives back of the light that gets to it, over
/// the squared index of the coat: ρ / η² · Σ (ρ R)^k with one term for each time that light meets
/// the base, where R is the share that gets back to it (CoatDiffuseShares::returned). Paths of at
/// most `max_depth` events in the layer count: the base is met at every other one.
Spectrum coated_base(const Spectrum& reflectance, float returned, float eta, int max_depth);

/// Light that is scattered by the base has forgotten where it came from, so that the sum over all
/// paths in the layer is a product: f = coat + T(wo) T(wi) / π · coated_base(), with T the share of
/// light from outside that gets to the base.
///
/// The model is that of Guo, Hašan & Zhao, "Position-Free Monte Carlo Simulation for Arbitrary
/// Layered BSDFs", 2018, as pbrt-v4 has it (Pharr, Jakob, Humphreys, "Physically Based Rendering",
/// 4th ed., 2023, section 14.3), for a layer that does not scatter.
struct CoatedDiffuseModel {
  Microfacet coat;
  float eta, thickness;
  Spectrum base;      ///< coated_base()
  float base_weight;  ///< base.mean() · CoatDiffuseShares::received
  CoatRow row;        ///< of a rough coat
  bool smooth;

  bool has_smooth() const { return !smooth || !base.is_black(); }
  bool has_delta() const { return smooth; }
  bool needs_choice() const { return base_weight > 0; }
  float nearly_specular_share() const;

  ModelEval eval(const Vector3f& wo, const Vector3f& wi, Transport) const;
  std::optional<ModelSample> sample(const Vector3f& wo, float u, const Point2f& v,
                                    Transport transport) const;

 private:
  float passed(float cosine) const {
    return smooth ? smooth_coat_transmittance(cosine, eta, thickness) : row(cosine);
  }
  /// Of sampling the coat, for light from this cosine of which `passed` gets to the base.
  float coat_probability(float cosine, float passed) const;
};

}  // namespace duet
