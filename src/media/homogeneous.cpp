#include "media/homogeneous.h"

#include <cassert>

namespace duet {

namespace {

/// Transmittances relative to that of a channel with extinction `chosen`. Equal extinctions stay
/// exactly equal, however long the way.
Spectrum relative_transmittance(const Spectrum& sigma_t, float chosen, float distance) {
  Spectrum t(1);
  for (int c = 0; c < 3; ++c)
    if (sigma_t[c] != chosen) t[c] = std::exp((chosen - sigma_t[c]) * distance);
  return t;
}

}  // namespace

HomogeneousMedium::HomogeneousMedium(const Spectrum& sigma_t, const ColorVolumeSlot& albedo,
                                     const PhaseFunction& phase, const Spectrum& emission)
    : Medium(phase, !emission.is_black()),
      sigma_t_(sigma_t),
      albedo_(albedo),
      emission_(emission),
      is_microflake_(phase.is_microflake()) {
  assert(!emits() || !albedo.grid);
}

inline Spectrum HomogeneousMedium::extinction(const Ray& ray) const {
  return is_microflake_ ? sigma_t_ * phase().extinction(ray.origin, -ray.direction) : sigma_t_;
}

float HomogeneousMedium::sample_distance(const Ray& ray, float u, RandomStream&,
                                         SpectralWeights& w) const {
  const Spectrum sigma_t = extinction(ray);
  const float chosen = sigma_t[w.channel];
  const float t = chosen > 0 ? -std::log1p(-u) / chosen : INFINITY;
  if (t < ray.tmax) {
    const Spectrum density = relative_transmittance(sigma_t, chosen, t) * sigma_t / chosen;
    w.pdf *= density;
    w.value *= density * albedo_(ray.origin + ray.direction * t);
    return t;
  }
  const Spectrum density = relative_transmittance(sigma_t, chosen, ray.tmax);
  w.pdf *= density;
  w.value *= density;
  // A light sample would have got here without fail.
  w.light *= chosen > 0 ? std::exp(chosen * ray.tmax) : 1.0f;
  return INFINITY;
}

inline Spectrum HomogeneousMedium::transmittance(const Ray& ray) const {
  const Spectrum sigma_t = extinction(ray);
  Spectrum t(1);
  for (int c = 0; c < 3; ++c)
    if (sigma_t[c] > 0) t[c] = std::exp(-sigma_t[c] * ray.tmax);
  return t;
}

void HomogeneousMedium::transmit(const Ray& ray, RandomStream&, SpectralWeights& w) const {
  const Spectrum t = transmittance(ray);
  w.value *= t;
  w.pdf *= t;
}

Spectrum HomogeneousMedium::emitted(const Ray& ray, RandomStream&) const {
  const Spectrum sigma_t = extinction(ray);
  Spectrum absorbed;  // of light that would have come all the way, by absorption
  for (int c = 0; c < 3; ++c)
    if (sigma_t[c] > 0) absorbed[c] = -std::expm1(-sigma_t[c] * ray.tmax);
  return absorbed * (Spectrum(1) - albedo_.constant) * emission_;
}

float HomogeneousMedium::nominal_transmittance(const Ray& ray) const {
  return transmittance(ray).mean();
}

}  // namespace duet
