// Diffuse reflection off a rough surface.
#pragma once

#include "materials/model.h"

namespace duet {

/// V-shaped grooves of Lambertian facets whose slopes vary by σ: shadowing, masking and one
/// interreflection. `fast` is the paper's simpler model, without interreflection.
/// Source: Oren & Nayar, "Generalization of Lambert's Reflectance Model", 1994.
struct RoughDiffuseModel {
  Spectrum reflectance;
  float sigma2;  ///< squared deviation of the facets' angles
  bool fast;

  bool has_smooth() const { return !reflectance.is_black(); }
  bool has_delta() const { return false; }
  bool needs_choice() const { return false; }

  ModelEval eval(const Vector3f& wo, const Vector3f& wi, Transport) const;
  std::optional<ModelSample> sample(const Vector3f& wo, float u, const Point2f& v,
                                    Transport transport) const;
};

}  // namespace duet
