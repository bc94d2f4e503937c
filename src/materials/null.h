// A surface that light passes without being changed.
#pragma once

#include "materials/model.h"

namespace duet {

/// A delta lobe straight ahead. It still counts as a vertex of the path.
struct NullModel {
  bool has_smooth() const { return false; }
  bool has_delta() const { return true; }
  bool needs_choice() const { return false; }
  ModelEval eval(const Vector3f&, const Vector3f&, Transport) const { return {}; }
  std::optional<ModelSample> sample(const Vector3f& wo, float, const Point2f&, Transport) const {
    return ModelSample{.wi = -wo, .weight = Spectrum(1), .pdf = 1, .delta = true, .null = true};
  }
};

}  // namespace duet
