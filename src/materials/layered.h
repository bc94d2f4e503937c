// A base under a dielectric coat with a scattering layer between them, by random walks in the
// layer.
#pragma once

#include "materials/fresnel.h"
#include "materials/microfacet.h"
#include "materials/model.h"

namespace duet {

/// The value of a pair of directions is an estimate by random walks between coat and base, whose
/// random numbers are a function of the seed and of the two directions. The same pair has the same
/// estimate, whichever way round; different pairs have independent ones, the mean of which is the
/// model's value. The density is a closed one and that of sample(): it has nothing random in it.
/// docs/decisions/0006-layered-bsdfs.md says why this is unbiased in all methods.
///
/// Source of model and estimator: Guo, Hašan & Zhao, "Position-Free Monte Carlo Simulation for
/// Arbitrary Layered BSDFs", 2018; Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th ed.,
/// 2023, section 14.3. The layer's extinction coefficient is one.
struct LayeredModel {
  Microfacet coat, metal;       ///< facets of the coat, and of a metal base
  float eta;                    ///< of the coat over the outside
  float thickness, g;           ///< of the layer; g in (−1, 1)
  Spectrum albedo;              ///< of the layer
  Spectrum base, base_k;        ///< diffuse reflectance; or index of the metal over the coat's
  uint32_t seed;                ///< differs from vertex to vertex
  uint16_t max_depth, samples;  ///< events in the layer, and walks per value
  bool smooth_coat, smooth_base, is_metal;

  bool scatters() const { return !albedo.is_black(); }
  /// Whether coat and base are mirrors.
  bool is_mirror() const { return smooth_coat && smooth_base; }
  bool has_smooth() const { return !is_mirror() || scatters(); }
  bool has_delta() const { return smooth_coat; }
  bool needs_choice() const { return has_smooth(); }
  float nearly_specular_share() const;

  ModelEval eval(const Vector3f& wo, const Vector3f& wi, Transport) const;
  float density(const Vector3f& wo, const Vector3f& wi) const;
  std::optional<ModelSample> sample(const Vector3f& wo, float u, const Point2f& v,
                                    Transport transport) const;

 private:
  /// Probabilities of the lobes from which sample() chooses, for one direction: the mirror, facets
  /// of the coat, facets with the slopes that the metal has if seen through the coat, and a diffuse
  /// lobe.
  struct Lobes {
    float mirror = 0, coat = 0, facets = 0, diffuse = 0;
    Microfacet seen;
    Spectrum mirrored;  ///< coefficient of the mirror
  };
  Lobes lobes(float cosine) const;
  Spectrum mirror_coefficient(float cosine) const;
  /// Estimate of the light that has been in the layer, without the cosine of wi.
  Spectrum from_below(const Vector3f& wo, const Vector3f& wi) const;
};

}  // namespace duet
