// Diffuse reflection by subsurface scattering.
#pragma once

#include <algorithm>
#include <cmath>

namespace duet {

/// The reflectance of the base under a smooth dielectric coat of relative index `eta` that gives
/// back as much light as the dipole of a medium, whose coefficients are per unit of length and of
/// any scale: `scattering`, reduced by its mean cosine, and `absorption`.
/// Source: Jensen et al., "A Practical Model for Subsurface Light Transport", SIGGRAPH 2001,
/// section 2.4, with its fit of internal reflection.
inline double base_like_dipole(double scattering, double absorption, double eta) {
  const double fdr = -1.440 / (eta * eta) + 0.710 / eta + 0.668 + 0.0636 * eta;
  const double a = (1 + fdr) / (1 - fdr);
  const double sum = scattering + absorption;
  const double albedo = sum > 0 ? scattering / sum : 0;
  const double root = std::sqrt(3 * (1 - albedo));
  const double total = 0.5 * albedo * (1 + std::exp(-4.0 / 3 * a * root)) * std::exp(-root);
  return std::min(total * eta * eta / (1 + total * eta * eta * fdr), 1.0);
}

}  // namespace duet
