// Metals: mirrors and rough reflectors with the Fresnel equations of a complex index.
#pragma once

#include "materials/fresnel.h"
#include "materials/microfacet.h"
#include "materials/model.h"

namespace duet {

/// A smooth metal: one delta lobe, on the upper side only.
struct ConductorModel {
  Spectrum eta, k;
  Spectrum specular_reflectance;

  bool has_smooth() const { return false; }
  bool has_delta() const { return true; }
  bool needs_choice() const { return false; }

  ModelEval eval(const Vector3f&, const Vector3f&, Transport) const { return {}; }
  [[gnu::always_inline]] BranchFreeSample sample_branch_free(const Vector3f& wo, float,
                                                             const Point2f&, Transport) const {
    BranchFreeSample s;
    s.wi = Vector3f(-wo.x, -wo.y, wo.z);
    s.weight = specular_reflectance * fresnel_conductor(wo.z, eta, k);
    s.pdf = 1;
    s.delta = 1;
    s.carries = wo.z > 0 ? 1 : 0;
    return s;
  }
  std::optional<ModelSample> sample(const Vector3f& wo, float u, const Point2f& v,
                                    Transport transport) const {
    return sample_branch_free(wo, u, v, transport).model_sample();
  }
};

/// Rough metal: single reflection off microfacets, on the upper side only.
/// Source: Walter et al., "Microfacet Models for Refraction through Rough Surfaces", 2007, eq. 20.
struct RoughConductorModel {
  Microfacet microfacet;
  Spectrum eta, k;
  Spectrum specular_reflectance;
  bool perfect = false;  ///< eta = 0: reflects all light

  bool has_smooth() const { return !specular_reflectance.is_black(); }
  bool has_delta() const { return false; }
  bool needs_choice() const { return false; }
  float nearly_specular_share() const { return microfacet.is_nearly_specular() ? 1.0f : 0.0f; }

  ModelEval eval(const Vector3f& wo, const Vector3f& wi, Transport) const;
  std::optional<ModelSample> sample(const Vector3f& wo, float, const Point2f& v, Transport) const;

  /// For the cosine of the angle to a facet.
  Spectrum reflectance(float cosine) const {
    return perfect ? specular_reflectance : by_index(cosine);
  }
  /// The same without a branch: for eta = 0 the Fresnel equations give exactly one.
  [[gnu::always_inline]] Spectrum by_index(float cosine) const {
    return specular_reflectance * fresnel_conductor(cosine, eta, k);
  }
};

}  // namespace duet
