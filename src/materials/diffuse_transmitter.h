// Ideally diffuse transmission, as through paper.
#pragma once

#include "materials/model.h"
#include "math/warp.h"

namespace duet {

/// f = τ / π between directions on different sides, from both sides alike.
struct DiffuseTransmitterModel {
  Spectrum transmittance;

  bool has_smooth() const { return !transmittance.is_black(); }
  bool has_delta() const { return false; }
  bool needs_choice() const { return false; }

  ModelEval eval(const Vector3f& wo, const Vector3f& wi, Transport) const {
    if (!(wo.z * wi.z < 0)) return {};
    const float pdf = std::abs(wi.z) * kInvPi;
    return {transmittance * pdf, pdf};
  }

  std::optional<ModelSample> sample(const Vector3f& wo, float, const Point2f& v, Transport) const {
    const Vector3f up = square_to_cosine_hemisphere(v);
    if (!(up.z > 0 && wo.z != 0)) return std::nullopt;
    return ModelSample{{up.x, up.y, wo.z > 0 ? -up.z : up.z}, transmittance, up.z * kInvPi};
  }
};

}  // namespace duet
