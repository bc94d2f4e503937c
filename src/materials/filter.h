// A filter in the way of light, such as a coloured foil: nothing is scattered.
#pragma once

#include "materials/model.h"

namespace duet {

/// Light passes straight through and is weakened; like NullModel, a vertex of the path.
struct FilterModel {
  Spectrum transmittance;

  bool has_smooth() const { return false; }
  bool has_delta() const { return true; }
  bool needs_choice() const { return false; }
  ModelEval eval(const Vector3f&, const Vector3f&, Transport) const { return {}; }
  std::optional<ModelSample> sample(const Vector3f& wo, float, const Point2f&, Transport) const {
    return ModelSample{.wi = -wo, .weight = transmittance, .pdf = 1, .delta = true, .null = true};
  }
};

}  // namespace duet
