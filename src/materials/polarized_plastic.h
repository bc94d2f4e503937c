// Plastic in the simplest way: reflection off microfacets, added to a base under a smooth coat.
#pragma once

#include "materials/microfacet.h"
#include "materials/model.h"

namespace duet {

/// Source: Baek, Jeon, Tong & Kim, "Simultaneous Acquisition of Polarimetric SVBRDF and Normals",
/// 2018, for light without polarisation. `eta` is the coat's index over the outside's.
struct PolarizedPlasticModel {
  Microfacet microfacet;
  float eta;
  Spectrum diffuse, specular;
  float specular_probability;

  bool has_smooth() const { return true; }
  bool has_delta() const { return false; }
  bool needs_choice() const { return specular_probability > 0 && specular_probability < 1; }
  float nearly_specular_share() const {
    return microfacet.is_nearly_specular() ? specular_probability : 0.0f;
  }

  ModelEval eval(const Vector3f& wo, const Vector3f& wi, Transport) const;
  std::optional<ModelSample> sample(const Vector3f& wo, float u, const Point2f& v,
                                    Transport transport) const;
};

}  // namespace duet
