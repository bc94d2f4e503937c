// Radiometric quantities in three linear sRGB channels.
#pragma once

#include <algorithm>
#include <cmath>

namespace duet {

/// Radiance, reflectance, throughput …: one number per linear sRGB primary.
struct Spectrum {
  float r = 0, g = 0, b = 0;

  constexpr Spectrum() = default;
  explicit constexpr Spectrum(float v) : r(v), g(v), b(v) {}
  constexpr Spectrum(float r_, float g_, float b_) : r(r_), g(g_), b(b_) {}

  constexpr bool operator==(const Spectrum&) const = default;
  constexpr float operator[](int i) const { return i == 0 ? r : i == 1 ? g : b; }
  constexpr float& operator[](int i) { return i == 0 ? r : i == 1 ? g : b; }
  constexpr Spectrum operator+(const Spectrum& o) const { return {r + o.r, g + o.g, b + o.b}; }
  constexpr Spectrum operator-(const Spectrum& o) const { return {r - o.r, g - o.g, b - o.b}; }
  constexpr Spectrum operator*(const Spectrum& o) const { return {r * o.r, g * o.g, b * o.b}; }
  constexpr Spectrum operator/(const Spectrum& o) const { return {r / o.r, g / o.g, b / o.b}; }
  constexpr Spectrum operator*(float s) const { return {r * s, g * s, b * s}; }
  constexpr Spectrum operator/(float s) const { return *this * (1.0f / s); }
  constexpr Spectrum& operator+=(const Spectrum& o) { return *this = *this + o; }
  constexpr Spectrum& operator*=(const Spectrum& o) { return *this = *this * o; }
  constexpr Spectrum& operator*=(float s) { return *this = *this * s; }
  friend constexpr Spectrum operator*(float s, const Spectrum& a) { return a * s; }

  constexpr bool is_black() const { return r == 0 && g == 0 && b == 0; }
  constexpr float max() const { return std::max(std::max(r, g), b); }
  constexpr float mean() const { return (r + g + b) * (1.0f / 3.0f); }
  /// CIE 1931 luminance of linear sRGB (Rec. 709 primaries, D65).
  constexpr float luminance() const { return 0.212671f * r + 0.715160f * g + 0.072169f * b; }
};

inline bool is_finite(const Spectrum& s) {
  return std::isfinite(s.r) && std::isfinite(s.g) && std::isfinite(s.b);
}
inline Spectrum sqrt(const Spectrum& s) {
  return {std::sqrt(s.r), std::sqrt(s.g), std::sqrt(s.b)};
}
constexpr Spectrum lerp(const Spectrum& a, const Spectrum& b, float t) {
  return a * (1 - t) + b * t;
}

/// The sRGB transfer curve (IEC 61966-2-1), from display value to linear and back.
inline float srgb_to_linear(float v) {
  return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}
inline float linear_to_srgb(float v) {
  return v <= 0.0031308f ? v * 12.92f : 1.055f * std::pow(v, 1.0f / 2.4f) - 0.055f;
}

}  // namespace duet
