// Burley's principled materials, solid and thin.
#pragma once

#include "materials/materials.h"

namespace duet {

/// Weights outside [0, 1] are clamped. A material that transmits and has eta = 1 gets 1.001, as in
/// Mitsuba.
struct PrincipledOptions {
  ColorSlot base_color{Spectrum(0.5f)};
  FloatSlot roughness{0.5f}, anisotropic{}, metallic{}, spec_trans{};
  float eta = 1.5f;
  FloatSlot spec_tint{}, sheen{}, sheen_tint{}, flatness{}, clearcoat{}, clearcoat_gloss{};
  float diffuse_reflectance_sampling_rate = 1, main_specular_sampling_rate = 1,
        clearcoat_sampling_rate = 1;
};

/// The index that belongs to Burley's `specular`. `transmits` says whether spec_trans is used.
float principled_eta(float specular, bool transmits);

class Principled final : public SingleModelMaterial<Principled> {
 public:
  explicit Principled(const PrincipledOptions& options);
  PrincipledModel model(const Surface& s) const;
  const ColorSlot& base_color() const { return options_.base_color; }
  /// The model but for its colour, if that is all that depends on the point, nothing is transmitted
  /// and there is neither a clear coat nor anisotropy.
  std::optional<PrincipledModel> uniform_reflection() const;
  SurfaceNeeds needs() const override;
  bool transmits() const override;
  Spectrum local_albedo(const Surface& s, const Vector3f&) const override {
    return options_.base_color(s);
  }
  void list_textures(std::vector<const Texture*>& out) const override {
    options_.base_color.list_texture(out);
  }

 private:
  PrincipledModel without_color(const Surface& s) const;

  PrincipledOptions options_;
};

/// Weights outside [0, 1] ([0, 2] for `diff_trans`) are clamped.
struct PrincipledThinOptions {
  ColorSlot base_color{Spectrum(0.5f)};
  FloatSlot roughness{0.5f}, anisotropic{}, spec_trans{}, eta{1.5f}, spec_tint{}, sheen{},
      sheen_tint{}, flatness{}, diff_trans{};
  float spec_reflectance_sampling_rate = 1, spec_transmittance_sampling_rate = 1,
        diffuse_reflectance_sampling_rate = 1, diffuse_transmittance_sampling_rate = 1;
};

class PrincipledThin final : public SingleModelMaterial<PrincipledThin> {
 public:
  explicit PrincipledThin(const PrincipledThinOptions& options);
  PrincipledThinModel model(const Surface& s) const;
  SurfaceNeeds needs() const override;
  bool transmits() const override;
  Spectrum local_albedo(const Surface& s, const Vector3f&) const override {
    return options_.base_color(s);
  }

 private:
  PrincipledThinOptions options_;
};

}  // namespace duet
