// Materials of pbrt-v3 that are not made of others. See materials.h.
#pragma once

#include "materials/fresnel_blend.h"
#include "materials/materials.h"

namespace duet {

class Substrate final : public SingleModelMaterial<Substrate> {
 public:
  Substrate(const ColorSlot& diffuse, const ColorSlot& specular, const RoughnessOptions& roughness);
  FresnelBlendModel model(const Surface& s) const;
  SurfaceNeeds needs() const override;
  bool transmits() const override { return false; }
  Spectrum local_albedo(const Surface& s, const Vector3f&) const override { return diffuse_(s); }

 private:
  ColorSlot diffuse_, specular_;
  RoughnessOptions roughness_;
};

/// Colours are clamped to [0, 1].
struct UberOptions {
  ColorSlot diffuse_reflectance{Spectrum(0.25f)}, diffuse_transmittance{};
  ColorSlot glossy_reflectance{Spectrum(0.25f)}, glossy_transmittance{};
  ColorSlot specular_reflectance{}, specular_transmittance{};
  ColorSlot opacity{Spectrum(1.0f)};
  FloatSlot eta{1.5f};
  RoughnessOptions roughness;
};

/// The sum of a diffuse surface, a rough and a smooth dielectric interface and what passes straight
/// through, each scaled by its colours. The sum may reflect more than it gets, if the colours do.
class Uber final : public Material {
 public:
  explicit Uber(const UberOptions& options) : options_(options) {}
  SurfaceNeeds needs() const override;
  int component_count() const override { return 4; }
  bool transmits() const override;
  bool passes_straight() const override;
  Spectrum local_albedo(const Surface& s, const Vector3f&) const override;

 protected:
  void add_components(const Surface& surface, BsdfBuilder& builder) const override;

 private:
  UberOptions options_;
};

}  // namespace duet
