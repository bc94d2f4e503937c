// Gaussian (Beckmann) facets of which those are sampled that can be seen. Without branches or
// calls, so that loops over many points have the same bits as code for one.
#pragma once

#include "math/exponential.h"
#include "math/frame.h"
#include "math/warp.h"

namespace duet {

/// Parts of the distribution for unit roughness.
namespace unit_beckmann {

/// Smith's G₁ / a for a = cos θ / (α sin θ) < 3; beyond that G₁ is 1.
/// The exact G₁ is 2 / (1 + erf a + exp(−a²) / (a √π)); this fit is off by 4e-7 of it at most.
[[gnu::always_inline]] inline float masking_over_a(float a) {
  const float p =
      3.5449090f + a * (0.045644434f + a * (1.0033726f + a * (0.095959995f + a * 0.096195459f)));
  const float q =
      1 + a * (1.7853704f +
               a * (1.3052161f + a * (0.54554701f + a * (0.18030357f + a * 0.089907170f))));
  return p / q;
}

/// 1 + erf(x), given exp(−x²). Off by 1.5e-7 at most.
/// Source: Abramowitz & Stegun, "Handbook of Mathematical Functions", 1964, 7.1.26.
[[gnu::always_inline]] inline float one_plus_erf(float x, float exp_minus_x2) {
  const float t = 1 / (1 + 0.3275911f * std::abs(x));
  const float tail =
      exp_minus_x2 * t *
      (0.254829592f +
       t * (-0.284496736f + t * (1.421413741f + t * (-1.453152027f + t * 1.061405429f))));
  return x < 0 ? tail : 2 - tail;
}

/// The inverse of erf at x = 1 − below = above − 1, for 0 < above < 2.
/// Source: Giles, "Approximating the erfinv Function", GPU Computing Gems Jade, 2012.
[[gnu::always_inline]] inline float inverse_erf(float above, float below) {
  const float x = above < 1 ? above - 1 : 1 - below;
  const float w = -polynomial_log(above * below);
  const float a = w - 2.5f, b = std::sqrt(w) - 3;
  const float middle =
      1.50140941f +
      a * (0.246640727f + a * (-0.00417768164f +
                               a * (-0.00125372503f +
                                    a * (0.000218580870f +
                                         a * (-4.39150654e-6f +
                                              a * (-3.5233877e-6f +
                                                   a * (3.43273939e-7f + a * 2.81022636e-8f)))))));
  const float tail =
      2.83297682f +
      b * (1.00167406f + b * (0.00943887047f +
                              b * (-0.0076224613f +
                                   b * (0.00573950773f +
                                        b * (-0.00367342844f +
                                             b * (0.00134934322f +
                                                  b * (0.000100950558f - b * 0.000200214257f)))))));
  return (w < 5 ? middle : tail) * x;
}

}  // namespace unit_beckmann

/// Directions lie in the upper hemisphere. See Microfacet, which has the same functions for any
/// distribution.
struct BeckmannFacets {
  float alpha_u, alpha_v, inv_u, inv_v;

  [[gnu::always_inline]] float density(const Vector3f& m) const {
    const float x = m.x * inv_u, y = m.y * inv_v, z2 = m.z * m.z;
    const float slope = x * x + y * y;
    const float d = kInvPi * inv_u * inv_v * polynomial_exp(-slope / z2) / (z2 * z2);
    // Facets this steep do not matter, but would divide zero by zero.
    return slope < 80 * z2 ? d : 0.0f;
  }

  /// The rational approximation (0.35 %) of Walter et al. that Mitsuba's BSDFs are defined with.
  [[gnu::always_inline]] float masking(const Vector3f& v) const {
    const float z = std::abs(v.z), across2 = sqr(alpha_u * v.x) + sqr(alpha_v * v.y);
    const float a = z / std::sqrt(across2);
    const float rational = a * (3.535f + 2.181f * a) / (1 + a * (2.276f + 2.577f * a));
    return z * z >= sqr(1.6f) * across2 ? 1.0f : rational;
  }

  /// See Microfacet::Core.
  struct Core {
    float value, density;
  };
  [[gnu::always_inline]] Core core(const Vector3f& o, const Vector3f& i, const Vector3f& h) const {
    const float d = density(h);
    const float across = std::sqrt(sqr(alpha_u * o.x) + sqr(alpha_v * o.y));
    const float a = o.z / across, all = 1 / o.z;
    // The density needs the exact masking function, or it would not integrate to one.
    const float below = unit_beckmann::masking_over_a(a) / across;
    const float rational_below = (3.535f + 2.181f * a) / ((1 + a * (2.276f + 2.577f * a)) * across);
    const float exact = a < 3 ? below : all, rational = a < 1.6f ? rational_below : all;
    return {d * rational * masking(i), d * exact};
  }

  [[gnu::always_inline]] Vector3f sample(const Vector3f& o, const Point2f& u) const;

 private:
  /// What the slope along the view has for its distribution function, for an angle θ.
  struct View {
    float c, s, cot;  ///< cos θ, sin θ and what is infinite at normal incidence
  };
  [[gnu::always_inline]] static float first_slope(const View& v, bool steep, float u);
  [[gnu::always_inline]] static float better_slope(const View& v, float target, float x);
};

/// Close to the slope of the quantile u: C is linear in erf x at normal incidence and close to
/// quadratic at grazing angles.
inline float BeckmannFacets::first_slope(const View& v, bool steep, float u) {
  const float end = unit_beckmann::one_plus_erf(v.cot, polynomial_exp(-v.cot * v.cot));
  const float erf_end = steep ? end : 2.0f;
  const float rest = std::max(1 - u, 0x1p-24f), root = std::sqrt(rest);
  const float s2 = v.s * v.s;
  const float grazing = s2 / (s2 - 0.1f * v.s * v.c + 0.4f * v.c * v.c);
  const float y = rest + grazing * ((root - rest) + 0.37f * root * (1 - root) * u);
  const float above = std::max(erf_end * (1 - y), 1e-7f);
  return std::min(unit_beckmann::inverse_erf(above, std::max(2 - above, 1e-7f)), v.cot);
}

/// A step of Halley's method.
inline float BeckmannFacets::better_slope(const View& v, float target, float x) {
  constexpr float kInvSqrtPi = 0.56418958354775628695f;
  const float e = polynomial_exp(-x * x);
  const float slope = std::max(v.c - v.s * x, 1e-6f);
  const float f = v.c * unit_beckmann::one_plus_erf(x, e) + v.s * kInvSqrtPi * e - target;
  const float newton = f / (2 * kInvSqrtPi * std::max(e * slope, 1e-20f));
  // Second over first derivative.
  const float bend = std::min(std::max(newton * (-2 * x - v.s / slope), -1.5f), 1.5f);
  return std::min(x - newton / (1 - 0.5f * bend), v.cot);
}

/// Slopes of a surface of unit roughness seen under the angle θ: the one across is Gaussian; the
/// one along the view has the distribution function
///   C(x) / C(cot θ),  C(x) = cos θ (1 + erf x) + sin θ exp(−x²) / √π,  x ≤ cot θ,
/// which is inverted by Halley's method.
/// Sources: Heitz & d'Eon, "Importance Sampling Microfacet-Based BSDFs using the Distribution of
/// Visible Normals", 2014; Jakob, "An Improved Visible Normal Sampling Routine for the Beckmann
/// Distribution", 2014.
inline Vector3f BeckmannFacets::sample(const Vector3f& o, const Point2f& u) const {
  const Vector3f w = normalize(Vector3f(alpha_u * o.x, alpha_v * o.y, o.z));
  const float s = std::sqrt(w.x * w.x + w.y * w.y);
  const View view{w.z, s, w.z / s};
  const bool steep = view.cot < 3;
  // C(cot θ) is 2 cos θ / G₁.
  const float masked = 2 * s / unit_beckmann::masking_over_a(view.cot);
  const float target = u.x * (steep ? masked : 2 * w.z);
  float x = first_slope(view, steep, u.x);
  x = better_slope(view, target, x);
  x = better_slope(view, target, x);
  const float v = std::min(std::max(2 * u.y, 1e-7f), 2 - 2.4e-7f);
  const float z = unit_beckmann::inverse_erf(v, 2 - v);
  // Turn the slopes to the azimuth of the view and undo the stretching.
  const float inv_s = 1 / std::max(s, 1e-30f);
  const float cos_phi = s > 0 ? w.x * inv_s : 1.0f, sin_phi = w.y * inv_s;
  return normalize(
      Vector3f(-alpha_u * (cos_phi * x - sin_phi * z), -alpha_v * (sin_phi * x + cos_phi * z), 1));
}

}  // namespace duet
