// Materials with a dielectric coat and a layer under it: which of the models they need at a point.
#pragma once

#include <optional>

#include "materials/coated_diffuse.h"
#include "materials/layered.h"
#include "materials/materials.h"

namespace duet {

/// A coat of GGX facets with correlated masking, smooth where both roughnesses are below
/// kSmoothAlpha, and a layer of optical thickness `thickness` that scatters light with `albedo`.
struct CoatLayerOptions {
  float eta = 1.5f;  ///< over that of the outside, > 0
  FloatSlot alpha_u{}, alpha_v{};
  FloatSlot thickness{0.01f};
  ColorSlot albedo{};
  FloatSlot g{};
  int max_depth = 10, samples = 1;  ///< at least 1

  /// Roughness below which pbrt takes a surface for a mirror.
  static constexpr float kSmoothAlpha = 1e-3f;

  /// Whether the layer is the same everywhere, only absorbs, and has an isotropic coat.
  bool has_closed_form() const;
  SurfaceNeeds needs() const;
  /// A model without its base.
  LayeredModel model(const Surface& s) const;
};

/// In closed form where there is one, or else by random walks.
class CoatedDiffuse final : public Material {
 public:
  CoatedDiffuse(const ColorSlot& reflectance, const CoatLayerOptions& options);
  SurfaceNeeds needs() const override;
  int component_count() const override { return 1; }
  bool transmits() const override { return false; }
  Spectrum local_albedo(const Surface& s, const Vector3f&) const override {
    return reflectance_(s);
  }
  CoatedDiffuseModel closed_model(const Surface& s) const;
  LayeredModel walk_model(const Surface& s) const;

 protected:
  void add_components(const Surface& surface, BsdfBuilder& builder) const override;

 private:
  ColorSlot reflectance_;
  CoatLayerOptions options_;
  CoatDiffuseShares smooth_shares_;
  std::optional<CoatTransmittance> tables_;  ///< of a coat that may be rough
};

/// Either the indices of the metal over the outside's, or what it reflects along the normal.
struct CoatedMetalOptions {
  ColorSlot eta{}, k{Spectrum(1.0f)};
  std::optional<ColorSlot> reflectance;
  FloatSlot alpha_u{}, alpha_v{};
};

class CoatedConductor final : public SingleModelMaterial<CoatedConductor> {
 public:
  CoatedConductor(const CoatedMetalOptions& metal, const CoatLayerOptions& options);
  LayeredModel model(const Surface& s) const;
  SurfaceNeeds needs() const override;
  bool transmits() const override { return false; }
  /// That of the metal along the normal.
  Spectrum local_albedo(const Surface& s, const Vector3f&) const override;

 private:
  CoatedMetalOptions metal_;
  CoatLayerOptions options_;
};

}  // namespace duet
