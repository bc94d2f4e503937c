// What a clear coat does to the light on its way to the material below it, and back.
//
// Source: Weidlich & Wilkie, "Arbitrarily Layered Micro-Facet Surfaces", 2007, for one layer over
// any material, with Fresnel terms in both directions.
#pragma once

#include "materials/fresnel.h"
#include "materials/rough_transmittance.h"
#include "math/frame.h"

namespace duet {

/// A layer with parallel sides. Directions are unit vectors that point away from the surface,
/// outside the coat or inside it, in a frame whose z axis is the normal.
class Coat {
 public:
  Coat() = default;
  /// `eta` is the coat's index over that of the outside, `absorption` that across the coat.
  /// `compensation` multiplies what passes: one over the probability of looking below the coat.
  Coat(float eta, const Spectrum& absorption, float compensation)
      : eta_(eta), compensation_(compensation), absorption_(absorption) {}
  /// The same with a rough interface, which lets pass what the row says.
  Coat(float eta, const Spectrum& absorption, float compensation, const TransmittanceRow& row)
      : Coat(eta, absorption, compensation) {
    rough_ = true;
    row_ = row;
  }

  /// The direction inside that belongs to one outside.
  Vector3f inside(const Vector3f& w) const { return refracted(w, 1 / eta_); }
  /// The direction outside; false if light that comes that way stays inside.
  bool outside(const Vector3f& w, Vector3f& out) const {
    const float sin2 = (1 - w.z * w.z) * (eta_ * eta_);
    if (!(sin2 < 1)) return false;
    out = refracted(w, eta_);
    return out.z != 0;
  }
  /// Solid angle inside per solid angle outside around the direction `out`, whose counterpart is
  /// `in`.
  float compression(const Vector3f& out, const Vector3f& in) const {
    return std::abs(out.z) / (eta_ * eta_ * std::max(std::abs(in.z), 1e-6f));
  }
  /// What of the light that comes in one direction and leaves in the other passes the coat, each
  /// given outside (`a`, `b`) and inside.
  Spectrum transmittance(const Vector3f& a, const Vector3f& a_in, const Vector3f& b,
                         const Vector3f& b_in) const {
    const float t = compensation_ * interface(std::abs(a.z)) * interface(std::abs(b.z));
    if (absorption_.is_black()) return Spectrum(t);
    const float path = 1 / std::abs(a_in.z) + 1 / std::abs(b_in.z);
    return {t * std::exp(-absorption_.r * path), t * std::exp(-absorption_.g * path),
            t * std::exp(-absorption_.b * path)};
  }

 private:
  static Vector3f refracted(const Vector3f& w, float scale) {
    const float x = w.x * scale, y = w.y * scale;
    return {x, y, std::copysign(safe_sqrt(1 - x * x - y * y), w.z)};
  }
  float interface(float cosine) const {
    return rough_ ? row_(cosine) : 1 - fresnel_dielectric(cosine, eta_).reflectance;
  }

  float eta_, compensation_;
  Spectrum absorption_;
  TransmittanceRow row_;
  bool rough_ = false;
};

}  // namespace duet
