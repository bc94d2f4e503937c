// Probability densities carry their measure in their type; one function converts between them.
#pragma once

#include "math/vector.h"

namespace duet {

/// A density per unit solid angle at the vertex that sends the direction.
struct PdfW {
  float value = 0;
  constexpr bool operator==(const PdfW&) const = default;
};

/// A density per unit area at the vertex that it describes.
struct PdfA {
  float value = 0;
  constexpr bool operator==(const PdfA&) const = default;
};

/// Density of a point on a surface turned into that of the direction towards it:
/// p_w = p_A d² / |cos|, with `cosine` taken at the described point.
/// Source: Veach, "Robust Monte Carlo Methods for Light Transport Simulation", 1997, eq. 8.10.
inline PdfW to_solid_angle(PdfA p, float distance_squared, float cosine) {
  const float c = std::abs(cosine);
  return {c > 0 ? p.value * distance_squared / c : 0.0f};
}

inline PdfA to_area(PdfW p, float distance_squared, float cosine) {
  return {distance_squared > 0 ? p.value * std::abs(cosine) / distance_squared : 0.0f};
}

}  // namespace duet
