// A clear coat over any other material.
#pragma once

#include <optional>

#include "materials/materials.h"

namespace duet {

/// `eta` is the coat's index over that of the outside; `sigma_a` absorbs per unit of `thickness`.
/// A rough coat has a roughness, of which only `alpha_u` counts.
struct CoatingOptions {
  float eta = 1.5046f / 1.000277f, thickness = 1;
  ColorSlot sigma_a{Spectrum(0.0f)}, specular_reflectance{Spectrum(1.0f)};
  std::optional<RoughnessOptions> roughness;
};

/// Reflects by itself, and lets through to `nested` what it does not reflect; reflections between
/// the two are left out, as in Mitsuba 0.6. `nested` must outlive it.
class Coating final : public Material {
 public:
  Coating(const CoatingOptions& options, const Material& nested);
  SurfaceNeeds needs() const override;
  int component_count() const override { return nested_.component_count() + 1; }
  bool transmits() const override { return nested_.transmits(); }
  bool perturbs() const override { return nested_.perturbs(); }
  CoverCount cover_count() const override { return nested_.cover_count().covered(); }
  Spectrum local_albedo(const Surface& surface, const Vector3f& wo) const override {
    return nested_.local_albedo(surface, wo);
  }

 protected:
  void add_components(const Surface& surface, BsdfBuilder& builder) const override;

 private:
  CoatingOptions options_;
  const Material& nested_;
  std::optional<RoughTransmittance> tables_;  ///< of a rough coat
};

}  // namespace duet
