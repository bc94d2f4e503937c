// How much light a smooth interface reflects.
//
// Cosines are those of the angle to the (micro)surface normal on the side that the light comes
// from, and at least zero. All results lie in [0, 1].
#pragma once

#include "math/spectrum.h"
#include "math/vector.h"

namespace duet {

/// Reflectance where light passes, too: `g` is η cos θ_t. Amplitudes a/b across and c/d in the
/// plane of incidence, with one division for both.
[[gnu::always_inline]] inline float transmitting_reflectance(float cos_i, float eta2, float g) {
  const float a = cos_i - g, b = cos_i + g;
  const float c = eta2 * cos_i - g, d = eta2 * cos_i + g;
  return std::min(0.5f * (sqr(a * d) + sqr(b * c)) / sqr(b * d), 1.0f);
}

/// Unpolarised reflection at a dielectric interface and the direction of refraction.
struct DielectricFresnel {
  float reflectance;
  float cos_t;  ///< on the far side; 0 under total internal reflection
};

/// Reflectance for eta ≠ 1, the index of the far side over that of the near side. Without branches:
/// for loops over many points, too.
[[gnu::always_inline]] inline float dielectric_reflectance(float cos_i, float eta) {
  const float eta2 = eta * eta;
  const float g2 = eta2 - (1 - cos_i * cos_i);
  const float transmitting = transmitting_reflectance(cos_i, eta2, safe_sqrt(g2));
  return std::min(g2, cos_i) > 0 ? transmitting : 1.0f;
}

/// The same with the direction of refraction. With eta = 1 nothing is reflected.
[[gnu::always_inline]] inline DielectricFresnel fresnel_dielectric(float cos_i, float eta) {
  const float g = safe_sqrt(eta * eta - (1 - cos_i * cos_i));  // η cos θ_t
  const float reflectance = dielectric_reflectance(cos_i, eta), cos_t = g / eta;
  return {eta == 1 ? 0.0f : reflectance, eta == 1 ? cos_i : cos_t};
}

/// Unpolarised reflection at a conductor with the complex index eta + i k (relative to the
/// outside). Source: Möller, "Optics", 1988; Lazányi & Szirmay-Kalos, "Fresnel Term Approximations
/// for Metals", 2005, give the same terms. Without branches: for loops over many points, too.
[[gnu::always_inline]] inline float fresnel_conductor(float cos_i, float eta, float k) {
  const float cos2 = cos_i * cos_i, sin2 = 1 - cos2;
  const float t = eta * eta - k * k - sin2;
  const float a2b2 = std::sqrt(t * t + 4 * eta * eta * k * k);
  const float a = safe_sqrt(0.5f * (a2b2 + t));
  const float s1 = a2b2 + cos2, s2 = 2 * cos_i * a;
  const float p1 = a2b2 * cos2 + sin2 * sin2, p2 = s2 * sin2;
  // Across the plane of incidence (s1 − s2) / (s1 + s2); the other is that times (p1 − p2) / (p1 +
  // p2).
  const float across = s1 + s2, along = p1 + p2;
  // At normal incidence on what has no index both may vanish.
  const float reflected = along > 0 ? p1 : 1.0f, met = along > 0 ? along : 1.0f;
  const float r = std::min(std::max((s1 - s2) * reflected / (across * met), 0.0f), 1.0f);
  return across > 0 ? r : 1.0f;
}

[[gnu::always_inline]] inline Spectrum fresnel_conductor(float cos_i, const Spectrum& eta,
                                                         const Spectrum& k) {
  return {fresnel_conductor(cos_i, eta.r, k.r), fresnel_conductor(cos_i, eta.g, k.g),
          fresnel_conductor(cos_i, eta.b, k.b)};
}

/// An index of a metal that fresnel_conductor() takes: beyond this it would overflow and change
/// nothing.
inline Spectrum bounded_index(const Spectrum& c) {
  const auto bound = [](float x) { return std::clamp(x, 0.0f, 1e4f); };
  return {bound(c.r), bound(c.g), bound(c.b)};
}

/// Share of diffuse light that a smooth dielectric interface reflects, by the fits that Mitsuba 3
/// uses. `eta` is the index of the far side over that of the near side. Sources: Egan & Hilgeman,
/// "Spectral Reflectance of Particulate Materials", 1973 (eta < 1); d'Eon & Irving, "A
/// Quantized-Diffusion Model for Rendering Translucent Materials", 2011 (eta ≥ 1).
inline float fresnel_diffuse_reflectance(float eta) {
  const float r = 1 / eta;
  if (eta >= 1)
    return std::clamp(
        0.919317f +
            r * (-3.4793f + r * (6.75335f + r * (-7.80989f + r * (4.98554f - r * 1.36881f)))),
        0.0f, 1.0f);
  const float fit = 0.6681f + 0.0636f * r + eta * (0.7099f - 1.4399f * eta);
  // Made for ordinary indices, the fit exceeds one where the index is large. Energy that enters and
  // leaves must balance: (1 − R(η)) η² = 1 − R(1/η).
  return fit < 0.96f ? fit : 1 - (1 - fresnel_diffuse_reflectance(r)) * eta * eta;
}

/// Schlick's (1 − cos)⁵.
/// Source: Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", 1994.
[[gnu::always_inline]] inline float schlick_weight(float cosine) {
  const float m = std::min(std::max(1 - cosine, 0.0f), 1.0f);
  return sqr(sqr(m)) * m;
}

/// schlick_weight() of the angle in the rarer medium, where the approximation holds.
[[gnu::always_inline]] inline float schlick_weight(float cos_i, float eta) {
  const float inside = safe_sqrt(1 - (1 - cos_i * cos_i) / (eta * eta));
  return schlick_weight(eta > 1 ? cos_i : inside);
}

/// Reflectance of a dielectric at normal incidence.
inline float normal_reflectance(float eta) {
  return sqr((eta - 1) / (eta + 1));
}

}  // namespace duet
