#include "materials/microfacet.h"

namespace duet {

namespace {

constexpr float kInvSqrtPi = 0.56418958354775628695f;

/// Smith's G₁ / a for Gaussian facets, where a = cos θ / (α sin θ) < 3; beyond that G₁ is 1.
/// The exact G₁ is 2 / (1 + erf a + exp(−a²) / (a √π)); this fit is off by 4e-7 of it at most.
float masking_over_a(float a) {
  const float p =
      3.5449090f + a * (0.045644434f + a * (1.0033726f + a * (0.095959995f + a * 0.096195459f)));
  const float q =
      1 + a * (1.7853704f +
               a * (1.3052161f + a * (0.54554701f + a * (0.18030357f + a * 0.089907170f))));
  return p / q;
}

/// 1 + erf(x), given exp(−x²). Off by 1.5e-7 at most.
/// Source: Abramowitz & Stegun, "Handbook of Mathematical Functions", 1964, 7.1.26.
float one_plus_erf(float x, float exp_minus_x2) {
  const float t = 1 / (1 + 0.3275911f * std::abs(x));
  const float tail =
      exp_minus_x2 * t *
      (0.254829592f +
       t * (-0.284496736f + t * (1.421413741f + t * (-1.453152027f + t * 1.061405429f))));
  return x < 0 ? tail : 2 - tail;
}

/// The inverse of erf at x = 1 − below = above − 1, for 0 < above < 2.
/// Source: Giles, "Approximating the erfinv Function", GPU Computing Gems Jade, 2012.
float inverse_erf(float above, float below) {
  const float x = above < 1 ? above - 1 : 1 - below;
  float w = -std::log(above * below);
  float p;
  if (w < 5) {
    w -= 2.5f;
    p = 1.50140941f + w * (0.246640727f +
                           w * (-0.00417768164f +
                                w * (-0.00125372503f +
                                     w * (0.000218580870f +
                                          w * (-4.39150654e-6f +
                                               w * (-3.5233877e-6f +
                                                    w * (3.43273939e-7f + w * 2.81022636e-8f)))))));
  } else {
    w = std::sqrt(w) - 3;
    p = 2.83297682f +
        w * (1.00167406f +
             w * (0.00943887047f +
                  w * (-0.0076224613f +
                       w * (0.00573950773f +
                            w * (-0.00367342844f +
                                 w * (0.00134934322f +
                                      w * (0.000100950558f - w * 0.000200214257f)))))));
  }
  return p * x;
}

}  // namespace

Microfacet::Core Microfacet::beckmann_core(float d, const Vector3f& o, const Vector3f& i) const {
  const float across = std::sqrt(sqr(alpha_u_ * o.x) + sqr(alpha_v_ * o.y));
  const float a = o.z / across;
  // The density needs the exact masking function, or it would not integrate to one.
  const float exact = a < 3 ? masking_over_a(a) / across : 1 / o.z;
  const float rational =
      a < 1.6f ? (3.535f + 2.181f * a) / ((1 + a * (2.276f + 2.577f * a)) * across) : 1 / o.z;
  return {d * rational * masking(i), d * exact};
}

Vector3f Microfacet::sample_all(const Point2f& u) const {
  const Point2f p = square_to_disk(u);
  const float r2 = std::min(p.x * p.x + p.y * p.y, kBelowOne);
  // Slopes of unit roughness at the distance that belongs to the quantile r².
  const float tan2_over_r2 = ggx_ ? 1 / (1 - r2) : (r2 > 1e-6f ? -std::log1p(-r2) / r2 : 1.0f);
  const float scale = std::sqrt(tan2_over_r2);
  return normalize(Vector3f(alpha_u_ * p.x * scale, alpha_v_ * p.y * scale, 1));
}

/// Slopes of a surface of unit roughness seen under the angle θ: the one across is Gaussian; the
/// one along the view has the distribution function
///   C(x) / C(cot θ),  C(x) = cos θ (1 + erf x) + sin θ exp(−x²) / √π,  x ≤ cot θ,
/// which is inverted by Halley's method.
/// Sources: Heitz & d'Eon, "Importance Sampling Microfacet-Based BSDFs using the Distribution of
/// Visible Normals", 2014; Jakob, "An Improved Visible Normal Sampling Routine for the Beckmann
/// Distribution", 2014.
Vector3f Microfacet::sample_visible_beckmann(const Vector3f& o, const Point2f& u) const {
  const Vector3f w = normalize(Vector3f(alpha_u_ * o.x, alpha_v_ * o.y, o.z));
  const float c = w.z, s = std::sqrt(w.x * w.x + w.y * w.y);
  const float cot = c / s;  // infinite at normal incidence
  const bool steep = cot < 3;
  // C(cot θ) is 2 cos θ / G₁.
  const float target = u.x * (steep ? 2 * s / masking_over_a(cot) : 2 * c);
  // Start from what is nearly right at both ends: C is linear in erf x at normal incidence and
  // close to quadratic at grazing angles.
  const float erf_end = steep ? one_plus_erf(cot, std::exp(-cot * cot)) : 2.0f;
  const float rest = std::max(1 - u.x, 0x1p-24f), root = std::sqrt(rest);
  const float grazing = s * s / (s * s - 0.1f * s * c + 0.4f * c * c);
  const float y = rest + grazing * ((root - rest) + 0.37f * root * (1 - root) * u.x);
  const float above = std::max(erf_end * (1 - y), 1e-7f);
  float x = std::min(inverse_erf(above, std::max(2 - above, 1e-7f)), cot);
  for (int k = 0; k < 2; ++k) {
    const float e = std::exp(-x * x);
    const float slope = std::max(c - s * x, 1e-6f);
    const float f = c * one_plus_erf(x, e) + s * kInvSqrtPi * e - target;
    const float newton = f / (2 * kInvSqrtPi * std::max(e * slope, 1e-20f));
    // Second over first derivative.
    const float bend = std::clamp(newton * (-2 * x - s / slope), -1.5f, 1.5f);
    x = std::min(x - newton / (1 - 0.5f * bend), cot);
  }
  const float v = std::clamp(2 * u.y, 1e-7f, 2 - 2.4e-7f);
  const float z = inverse_erf(v, 2 - v);
  // Turn the slopes to the azimuth of the view and undo the stretching.
  const float inv_s = s > 0 ? 1 / s : 0.0f;
  const float cos_phi = s > 0 ? w.x * inv_s : 1.0f, sin_phi = w.y * inv_s;
  return normalize(Vector3f(-alpha_u_ * (cos_phi * x - sin_phi * z),
                            -alpha_v_ * (sin_phi * x + cos_phi * z), 1));
}

}  // namespace duet
