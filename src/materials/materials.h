// The materials that scatter light themselves, with their parameters: what the build stage makes by
// name.
//
// Parameters have Mitsuba 3's names, meanings and defaults. Materials keep pointers to textures,
// which must outlive them.
#pragma once

#include "materials/material.h"
#include "textures/texture.h"

namespace duet {

/// Whether none of the slots has a texture, or one that reads texture coordinates.
template <class... Slots>
bool all_constant(const Slots&... slots) {
  return (slots.is_constant() && ...);
}
template <class... Slots>
bool any_needs_uv(const Slots&... slots) {
  return (slots.needs_uv() || ...);
}
/// Whether a weight is anything but zero somewhere.
inline bool is_used(const FloatSlot& slot) {
  return !slot.is_constant() || slot.constant != 0;
}

/// A rough interface. Roughness below Microfacet::kMinAlpha is raised to it.
struct RoughnessOptions {
  MicrofacetDistribution distribution = MicrofacetDistribution::beckmann;
  FloatSlot alpha_u{0.1f}, alpha_v{0.1f};
  bool sample_visible = true;

  Microfacet operator()(const Surface& s) const {
    const float u = alpha_u(s);
    return {distribution, u, is_isotropic() ? u : alpha_v(s), sample_visible};
  }
  bool is_isotropic() const {
    return alpha_u.texture == alpha_v.texture &&
           (alpha_u.texture || alpha_u.constant == alpha_v.constant);
  }
  SurfaceNeeds needs() const {
    return {.uv = any_needs_uv(alpha_u, alpha_v), .tangents = !is_isotropic()};
  }
};

class Diffuse final : public SingleModelMaterial<Diffuse> {
 public:
  explicit Diffuse(const ColorSlot& reflectance);
  DiffuseModel model(const Surface& s) const { return {reflectance_(s)}; }
  SurfaceNeeds needs() const override;
  bool transmits() const override { return false; }
  Spectrum local_albedo(const Surface& s, const Vector3f&) const override {
    return reflectance_(s);
  }
  void list_textures(std::vector<const Texture*>& out) const override {
    reflectance_.list_texture(out);
  }
  const ColorSlot& reflectance() const { return reflectance_; }

 private:
  ColorSlot reflectance_;
};

class Null final : public SingleModelMaterial<Null> {
 public:
  Null() { set_constant(NullModel{}); }
  NullModel model(const Surface&) const { return {}; }
  SurfaceNeeds needs() const override { return {}; }
  bool transmits() const override { return true; }
  bool passes_straight() const override { return true; }
};

/// `eta` and `k` are relative to the outside; eta = 0 is a perfect mirror.
struct ConductorOptions {
  ColorSlot eta{Spectrum(0.0f)}, k{Spectrum(1.0f)};
  ColorSlot specular_reflectance{Spectrum(1.0f)};
};

class Conductor final : public SingleModelMaterial<Conductor> {
 public:
  explicit Conductor(const ConductorOptions& options);
  ConductorModel model(const Surface& s) const;
  SurfaceNeeds needs() const override;
  bool transmits() const override { return false; }

 private:
  ConductorOptions options_;
};

class RoughConductor final : public SingleModelMaterial<RoughConductor> {
 public:
  RoughConductor(const ConductorOptions& options, const RoughnessOptions& roughness);
  RoughConductorModel model(const Surface& s) const;
  /// The conductor without its specular reflectance, which is 1 here, if the rest is the same
  /// everywhere.
  std::optional<RoughConductorModel> uniform() const;
  const ColorSlot& specular_reflectance() const { return options_.specular_reflectance; }
  void list_textures(std::vector<const Texture*>& out) const override {
    options_.specular_reflectance.list_texture(out);
  }
  SurfaceNeeds needs() const override;
  bool transmits() const override { return false; }

 private:
  ConductorOptions options_;
  RoughnessOptions roughness_;
};

/// `eta` > 0 is the index of the inside over that of the outside.
struct DielectricOptions {
  FloatSlot eta{1.5046f / 1.000277f};
  ColorSlot specular_reflectance{Spectrum(1.0f)}, specular_transmittance{Spectrum(1.0f)};
};

class Dielectric final : public SingleModelMaterial<Dielectric> {
 public:
  explicit Dielectric(const DielectricOptions& options);
  DielectricModel model(const Surface& s) const;
  SurfaceNeeds needs() const override;
  bool transmits() const override { return true; }

 private:
  DielectricOptions options_;
};

class RoughDielectric final : public SingleModelMaterial<RoughDielectric> {
 public:
  RoughDielectric(const DielectricOptions& options, const RoughnessOptions& roughness);
  RoughDielectricModel model(const Surface& s) const;
  SurfaceNeeds needs() const override;
  bool transmits() const override { return true; }

 private:
  DielectricOptions options_;
  RoughnessOptions roughness_;
};

class ThinDielectric final : public SingleModelMaterial<ThinDielectric> {
 public:
  explicit ThinDielectric(const DielectricOptions& options);
  ThinDielectricModel model(const Surface& s) const;
  SurfaceNeeds needs() const override;
  bool transmits() const override { return true; }
  bool passes_straight() const override { return true; }

 private:
  DielectricOptions options_;
};

struct PlasticOptions {
  float eta = 1.49f / 1.000277f;
  ColorSlot diffuse_reflectance{Spectrum(0.5f)}, specular_reflectance{Spectrum(1.0f)};
  bool nonlinear = false;
};

class Plastic final : public SingleModelMaterial<Plastic> {
 public:
  explicit Plastic(const PlasticOptions& options);
  PlasticModel model(const Surface& s) const;
  /// The plastic without its base, if the rest is the same everywhere.
  std::optional<UniformPlastic> uniform() const;
  const ColorSlot& base() const { return options_.diffuse_reflectance; }
  SurfaceNeeds needs() const override;
  bool transmits() const override { return false; }
  Spectrum local_albedo(const Surface& s, const Vector3f&) const override {
    return options_.diffuse_reflectance(s);
  }
  void list_textures(std::vector<const Texture*>& out) const override {
    options_.diffuse_reflectance.list_texture(out);
  }

 private:
  UniformPlastic plastic(const Spectrum& specular_reflectance) const {
    return {options_.eta, specular_reflectance, internal_reflectance_, options_.nonlinear};
  }

  PlasticOptions options_;
  float internal_reflectance_;
};

/// Isotropic: of the roughness only `alpha_u` counts.
class RoughPlastic final : public SingleModelMaterial<RoughPlastic> {
 public:
  RoughPlastic(const PlasticOptions& options, const RoughnessOptions& roughness);
  RoughPlasticModel model(const Surface& s) const;
  /// The plastic without its base, if the rest is the same everywhere.
  std::optional<UniformRoughPlastic> uniform() const;
  const ColorSlot& base() const { return options_.diffuse_reflectance; }
  SurfaceNeeds needs() const override;
  bool transmits() const override { return false; }
  Spectrum local_albedo(const Surface& s, const Vector3f&) const override {
    return options_.diffuse_reflectance(s);
  }
  void list_textures(std::vector<const Texture*>& out) const override {
    options_.diffuse_reflectance.list_texture(out);
  }

 private:
  PlasticOptions options_;
  RoughnessOptions roughness_;
  RoughTransmittance tables_;
};

/// Of two reflectances, the share of the first: how often its lobe is sampled.
inline float share_of_first(const Spectrum& first, const Spectrum& second) {
  const float a = first.luminance(), b = second.luminance();
  return a + b > 0 ? a / (a + b) : 0.0f;
}

/// `exponent` ≥ 0.
struct PhongOptions {
  ColorSlot diffuse_reflectance{Spectrum(0.5f)}, specular_reflectance{Spectrum(0.2f)};
  FloatSlot exponent{30};
};

class Phong final : public SingleModelMaterial<Phong> {
 public:
  explicit Phong(const PhongOptions& options);
  PhongModel model(const Surface& s) const;
  SurfaceNeeds needs() const override;
  bool transmits() const override { return false; }
  Spectrum local_albedo(const Surface& s, const Vector3f&) const override {
    return options_.diffuse_reflectance(s);
  }

 private:
  PhongOptions options_;
};

/// Roughness below Microfacet::kMinAlpha is raised to it.
struct WardOptions {
  ColorSlot diffuse_reflectance{Spectrum(0.5f)}, specular_reflectance{Spectrum(0.2f)};
  FloatSlot alpha_u{0.1f}, alpha_v{0.1f};
  WardVariant variant = WardVariant::balanced;
};

class Ward final : public SingleModelMaterial<Ward> {
 public:
  explicit Ward(const WardOptions& options);
  WardModel model(const Surface& s) const;
  SurfaceNeeds needs() const override;
  bool transmits() const override { return false; }
  Spectrum local_albedo(const Surface& s, const Vector3f&) const override {
    return options_.diffuse_reflectance(s);
  }

 private:
  WardOptions options_;
};

/// `alpha` is the roughness of a Beckmann distribution with the same slopes.
class RoughDiffuse final : public SingleModelMaterial<RoughDiffuse> {
 public:
  RoughDiffuse(const ColorSlot& reflectance, const FloatSlot& alpha, bool fast);
  RoughDiffuseModel model(const Surface& s) const;
  SurfaceNeeds needs() const override;
  bool transmits() const override { return false; }
  Spectrum local_albedo(const Surface& s, const Vector3f&) const override {
    return reflectance_(s);
  }

 private:
  ColorSlot reflectance_;
  FloatSlot alpha_;
  bool fast_;
};

class DiffuseTransmitter final : public SingleModelMaterial<DiffuseTransmitter> {
 public:
  explicit DiffuseTransmitter(const ColorSlot& transmittance);
  DiffuseTransmitterModel model(const Surface& s) const { return {transmittance_(s)}; }
  SurfaceNeeds needs() const override;
  bool transmits() const override { return true; }
  Spectrum local_albedo(const Surface& s, const Vector3f&) const override {
    return transmittance_(s);
  }

 private:
  ColorSlot transmittance_;
};

}  // namespace duet
