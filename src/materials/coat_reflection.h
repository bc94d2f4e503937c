// The mirror reflection of a clear coat, without what is below it.
#pragma once

#include "materials/fresnel.h"
#include "materials/model.h"

namespace duet {

/// A delta lobe on both sides. `eta` is the coat's index over that of the outside.
struct CoatReflectionModel {
  float eta;
  Spectrum reflectance;  ///< factor of the physical reflection

  bool has_smooth() const { return false; }
  bool has_delta() const { return true; }
  bool needs_choice() const { return false; }
  ModelEval eval(const Vector3f&, const Vector3f&, Transport) const { return {}; }
  std::optional<ModelSample> sample(const Vector3f& wo, float, const Point2f&, Transport) const {
    if (wo.z == 0) return std::nullopt;
    const float f = fresnel_dielectric(std::abs(wo.z), eta).reflectance;
    return ModelSample{.wi = reflect(wo), .weight = reflectance * f, .pdf = 1, .delta = true};
  }
};

}  // namespace duet
