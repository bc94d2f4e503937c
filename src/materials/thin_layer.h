// A thin layer of a scattering medium, such as a leaf, seen as a surface: light is scattered in it
// once or passes.
#pragma once

#include "materials/model.h"

namespace duet {

/// Source: Hanrahan & Krueger, "Reflection from Layered Surfaces due to Subsurface Scattering",
/// 1993: the first-order terms for a layer without interfaces, in the form for single scattering
/// by Chandrasekhar.
struct ThinLayerModel {
  Spectrum albedo;
  Spectrum depth;  ///< optical thickness
  float g;         ///< mean cosine of the deflection (Henyey-Greenstein)

  bool has_smooth() const { return !albedo.is_black() && !depth.is_black(); }
  bool has_delta() const { return true; }
  bool needs_choice() const { return true; }

  /// What passes without being scattered.
  Spectrum straight_through(const Vector3f& wo) const;
  ModelEval eval(const Vector3f& wo, const Vector3f& wi, Transport) const;
  std::optional<ModelSample> sample(const Vector3f& wo, float u, const Point2f& v,
                                    Transport transport) const;
};

}  // namespace duet
