// Burley's principled material for thin sheets, as parametrised by Mitsuba 3: both sides look alike
// and nothing is bent.
//
// Source: Burley, "Extending the Disney BRDF to a BSDF with Integrated Subsurface Scattering",
// 2015.
#pragma once

#include "materials/principled.h"

namespace duet {

/// Diffuse and specular lobes, reflected and transmitted.
struct PrincipledThinModel {
  Microfacet facets;               ///< of reflection
  Microfacet transmission_facets;  ///< smoother or rougher, by the index
  Spectrum base_color, tint;
  float roughness, spec_trans, eta, spec_tint;
  float sheen, sheen_tint, flatness;
  float diff_trans;  ///< share of the diffuse light that is transmitted, 0 to 1
  /// Probabilities of the lobes.
  float pick_reflection, pick_transmission, pick_diffuse, pick_diffuse_transmission;

  bool has_smooth() const { return true; }
  bool has_delta() const { return false; }
  bool needs_choice() const { return true; }
  float nearly_specular_share() const {
    return (facets.is_nearly_specular() ? pick_reflection : 0.0f) +
           (transmission_facets.is_nearly_specular() ? pick_transmission : 0.0f);
  }

  ModelEval eval(const Vector3f& wo, const Vector3f& wi, Transport transport) const;
  std::optional<ModelSample> sample(const Vector3f& wo, float u, const Point2f& v,
                                    Transport transport) const;

 private:
  ModelEval eval_reflection(const Vector3f& o, const Vector3f& i) const;
  ModelEval eval_transmission(const Vector3f& o, const Vector3f& i, Transport transport) const;
};

}  // namespace duet
