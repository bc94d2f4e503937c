// Ideally diffuse transmission, as through paper, and reflection off it.
#pragma once

#include "materials/model.h"
#include "math/warp.h"

namespace duet {

/// f = τ / π between directions on different sides and ρ / π between those on the same one, from
/// both sides alike.
struct DiffuseTransmitterModel {
  Spectrum transmittance, reflectance = Spectrum(0.0f);

  bool has_smooth() const { return !(transmittance.is_black() && reflectance.is_black()); }
  bool has_delta() const { return false; }
  bool needs_choice() const { return !transmittance.is_black() && !reflectance.is_black(); }

  ModelEval eval(const Vector3f& wo, const Vector3f& wi, Transport) const {
    const float sides = wo.z * wi.z;
    if (sides == 0) return {};
    const float pdf = std::abs(wi.z) * kInvPi, p = reflection_share();
    return sides < 0 ? ModelEval{transmittance * pdf, pdf * (1 - p)}
                     : ModelEval{reflectance * pdf, pdf * p};
  }

  std::optional<ModelSample> sample(const Vector3f& wo, float u, const Point2f& v,
                                    Transport) const {
    const Vector3f up = square_to_cosine_hemisphere(v);
    if (!(up.z > 0 && wo.z != 0)) return std::nullopt;
    const float p = reflection_share();
    const bool reflects = u < p;
    const float share = reflects ? p : 1 - p;
    return ModelSample{{up.x, up.y, (wo.z > 0) == reflects ? up.z : -up.z},
                       (reflects ? reflectance : transmittance) / share,
                       up.z * kInvPi * share};
  }

 private:
  /// How often the reflection is sampled.
  float reflection_share() const {
    const float r = reflectance.mean(), t = transmittance.mean();
    return r > 0 ? r / (r + t) : 0.0f;
  }
};

}  // namespace duet
