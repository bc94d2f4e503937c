// Materials that scatter light in ways of their own, with their parameters: fibres, measurements,
// filters. See materials.h.
#pragma once

#include "materials/materials.h"
#include "math/angles.h"

namespace duet {

/// See HairModel; roughnesses of textures are taken to [0, 1].
struct HairOptions {
  FloatSlot longitudinal_roughness{0.3f}, azimuthal_roughness{0.3f};
  FloatSlot scale_tilt{2};  ///< in degrees
  FloatSlot eta{1.55f / 1.000277f};
  /// The colour of many hairs, or absorption per radius; without both, concentrations of pigments.
  std::optional<ColorSlot> reflectance, absorption;
  float absorption_scale = 1;
  FloatSlot eumelanin{1.3f}, pheomelanin{0.2f};
};

class HairFibre final : public SingleModelMaterial<HairFibre> {
 public:
  explicit HairFibre(const HairOptions& options);
  HairModel model(const Surface& s) const;
  SurfaceNeeds needs() const override;
  bool transmits() const override { return true; }

 private:
  Spectrum absorption(const Surface& s, float azimuthal_roughness) const;
  /// Of those that the model is made from.
  std::vector<const Texture*> textures() const;

  HairOptions options_;
};

class Measured final : public SingleModelMaterial<Measured> {
 public:
  explicit Measured(std::shared_ptr<const MeasuredTable> table) : brdf_(std::move(table)) {
    set_constant(model({}));
  }
  MeasuredModel model(const Surface&) const { return {&brdf_}; }
  SurfaceNeeds needs() const override { return {.tangents = true}; }
  bool transmits() const override { return false; }

 private:
  MeasuredBrdf brdf_;
};

class PolarizedPlastic final : public SingleModelMaterial<PolarizedPlastic> {
 public:
  PolarizedPlastic(const PlasticOptions& options, const RoughnessOptions& roughness);
  PolarizedPlasticModel model(const Surface& s) const;
  SurfaceNeeds needs() const override;
  bool transmits() const override { return false; }

 private:
  PlasticOptions options_;
  RoughnessOptions roughness_;
};

/// What passes is multiplied by the transmittance and by `scale`.
class Filter final : public SingleModelMaterial<Filter> {
 public:
  /// `has_albedo`: as Mitsuba's circular polariser, it shows its transmittance in the albedo layer.
  Filter(const ColorSlot& transmittance, float scale, bool has_albedo);
  FilterModel model(const Surface& s) const { return {transmittance_(s) * scale_}; }
  SurfaceNeeds needs() const override;
  bool transmits() const override { return true; }
  bool passes_straight() const override { return true; }
  Spectrum local_albedo(const Surface& s, const Vector3f&) const override {
    return has_albedo_ ? transmittance_(s) : Spectrum(0);
  }

 private:
  ColorSlot transmittance_;
  float scale_;
  bool has_albedo_;
};

/// Coefficients are per unit of `thickness`.
struct ThinLayerOptions {
  ColorSlot sigma_s{Spectrum(1.0f)}, sigma_a{Spectrum(0.0f)};
  float thickness = 1, g = 0;
};

class ThinLayer final : public SingleModelMaterial<ThinLayer> {
 public:
  explicit ThinLayer(const ThinLayerOptions& options);
  ThinLayerModel model(const Surface& s) const;
  SurfaceNeeds needs() const override;
  bool transmits() const override { return true; }
  bool passes_straight() const override { return true; }

 private:
  ThinLayerOptions options_;
};

}  // namespace duet
