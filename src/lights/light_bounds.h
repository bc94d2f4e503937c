// Where lights are and into which directions they shine: what a light tree knows of a cluster.
#pragma once

#include "geometry/shape.h"

namespace duet {

/// Directions around an axis.
struct DirectionCone {
  Vector3f axis{0, 0, 1};  ///< unit length
  float angle = 0;         ///< between the axis and the outermost direction, 0 to π

  static DirectionCone all() { return {{0, 0, 1}, kPi}; }
  /// Makes it hold another cone, too.
  void extend(const DirectionCone& c);
};

/// Bounds of a light or of a cluster of them. Nothing leaves further from the normals than
/// `spread`, and up to there no more than the cosine of that angle.
/// Source: Conty Estevez & Kulla, "Importance Sampling of Many Lights with Adaptive Tree
/// Splitting", HPG 2018, section 4.1 (θ_o and θ_e there).
struct LightBounds {
  Bounds box;
  DirectionCone normals;      ///< the angle is θ_o
  float spread = 0.5f * kPi;  ///< θ_e
  float power = 0;

  /// Of something that shines into all directions.
  static LightBounds around(const Bounds& box) { return {box, DirectionCone::all()}; }
  void extend(const LightBounds& b);
  /// M_Ω: the integral of the bound on directions, the cosine of the angle beyond θ_o, over all
  /// directions. π for a flat Lambertian light, 4π for all directions. Source: the same,
  /// equation 1.
  float measure() const;
};

}  // namespace duet
