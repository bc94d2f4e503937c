// Ideally diffuse reflection.
#pragma once

#include "materials/model.h"
#include "math/warp.h"

namespace duet {

/// Lambert's law: f = ρ / π on the upper side, nothing below.
struct DiffuseModel {
  Spectrum reflectance;

  bool has_smooth() const { return !reflectance.is_black(); }
  bool has_delta() const { return false; }
  bool needs_choice() const { return false; }

  ModelEval eval(const Vector3f& wo, const Vector3f& wi, Transport) const {
    if (!(wo.z > 0 && wi.z > 0)) return {};
    const float pdf = wi.z * kInvPi;
    return {reflectance * pdf, pdf};
  }

  std::optional<ModelSample> sample(const Vector3f& wo, float, const Point2f& v, Transport) const {
    if (!(wo.z > 0)) return std::nullopt;
    const Vector3f wi = square_to_cosine_hemisphere(v);
    if (!(wi.z > 0)) return std::nullopt;
    return ModelSample{wi, reflectance, wi.z * kInvPi};
  }
};

}  // namespace duet
