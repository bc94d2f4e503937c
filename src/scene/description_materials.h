// Materials as plain data.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "materials/measured_table.h"
#include "materials/microfacet_kind.h"
#include "materials/ward_variant.h"
#include "scene/description_base.h"

namespace duet {

/// A rough interface; absent where the interface is smooth.
struct Roughness {
  MicrofacetDistribution distribution = MicrofacetDistribution::beckmann;
  FloatInput alpha_u = 0.1, alpha_v = 0.1;
  bool sample_visible = true;
  bool operator==(const Roughness&) const = default;
};

struct DiffuseMaterial {
  ColorInput reflectance = Spectrum(0.5f);
  bool operator==(const DiffuseMaterial&) const = default;
};

/// `eta` and `k` are relative to the outside. A perfect mirror has eta = 0 and k = 1.
struct ConductorMaterial {
  ColorInput eta = Spectrum(0.0f), k = Spectrum(1.0f);
  ColorInput specular_reflectance = Spectrum(1.0f);
  std::optional<Roughness> roughness;
  bool operator==(const ConductorMaterial&) const = default;
};

struct DielectricMaterial {
  FloatInput eta = 1.5046 / 1.000277;  ///< inside over outside
  ColorInput specular_reflectance = Spectrum(1.0f), specular_transmittance = Spectrum(1.0f);
  std::optional<Roughness> roughness;
  bool operator==(const DielectricMaterial&) const = default;
};

struct ThinDielectricMaterial {
  double eta = 1.5046 / 1.000277;
  ColorInput specular_reflectance = Spectrum(1.0f), specular_transmittance = Spectrum(1.0f);
  bool operator==(const ThinDielectricMaterial&) const = default;
};

struct PlasticMaterial {
  double eta = 1.49 / 1.000277;
  ColorInput diffuse_reflectance = Spectrum(0.5f), specular_reflectance = Spectrum(1.0f);
  bool nonlinear = false;
  std::optional<Roughness> roughness;  ///< isotropic: alpha_v equals alpha_u
  bool operator==(const PlasticMaterial&) const = default;
};

/// Burley 2012 and 2015, as parametrised by Mitsuba 3.
struct PrincipledMaterial {
  ColorInput base_color = Spectrum(0.5f);
  FloatInput roughness = 0.5, anisotropic = 0.0, metallic = 0.0, spec_trans = 0.0;
  /// The index of refraction, or Burley's `specular`; Mitsuba takes one of them.
  double eta = 1.5;
  std::optional<double> specular;
  FloatInput spec_tint = 0.0, sheen = 0.0, sheen_tint = 0.0, flatness = 0.0;
  FloatInput clearcoat = 0.0, clearcoat_gloss = 0.0;
  double diffuse_reflectance_sampling_rate = 1, main_specular_sampling_rate = 1,
         clearcoat_sampling_rate = 1;
  bool operator==(const PrincipledMaterial&) const = default;
};

struct PrincipledThinMaterial {
  ColorInput base_color = Spectrum(0.5f);
  FloatInput roughness = 0.5, anisotropic = 0.0, spec_trans = 0.0, eta = 1.5, spec_tint = 0.0,
             sheen = 0.0, sheen_tint = 0.0, flatness = 0.0, diff_trans = 0.0;
  double spec_reflectance_sampling_rate = 1, spec_transmittance_sampling_rate = 1,
         diffuse_reflectance_sampling_rate = 1, diffuse_transmittance_sampling_rate = 1;
  bool operator==(const PrincipledThinMaterial&) const = default;
};

struct PhongMaterial {
  ColorInput diffuse_reflectance = Spectrum(0.5f), specular_reflectance = Spectrum(0.2f);
  FloatInput exponent = 30.0;
  bool operator==(const PhongMaterial&) const = default;
};

struct WardMaterial {
  WardVariant variant = WardVariant::balanced;
  ColorInput diffuse_reflectance = Spectrum(0.5f), specular_reflectance = Spectrum(0.2f);
  FloatInput alpha_u = 0.1, alpha_v = 0.1;
  bool operator==(const WardMaterial&) const = default;
};

struct RoughDiffuseMaterial {
  ColorInput reflectance = Spectrum(0.5f);
  FloatInput alpha = 0.2;
  bool use_fast_approx = false;
  bool operator==(const RoughDiffuseMaterial&) const = default;
};

struct DiffuseTransmitterMaterial {
  ColorInput transmittance = Spectrum(0.5f);
  bool operator==(const DiffuseTransmitterMaterial&) const = default;
};

/// Chiang et al. 2016, as parametrised by Mitsuba 3; absorption is per radius.
struct HairMaterial {
  double longitudinal_roughness = 0.3, azimuthal_roughness = 0.3;
  double scale_tilt = 2;  ///< in degrees
  double eta = 1.55 / 1.000277;
  /// Concentrations, unless `sigma_a` is given.
  double eumelanin = 1.3, pheomelanin = 0.2;
  std::optional<ColorInput> sigma_a;
  double scale = 1;  ///< of sigma_a
  bool operator==(const HairMaterial&) const = default;
};

struct MeasuredMaterial {
  std::shared_ptr<const MeasuredTable> table;
  std::string file;
  friend bool operator==(const MeasuredMaterial& a, const MeasuredMaterial& b) {
    return a.table == b.table || (a.table && b.table && *a.table == *b.table);
  }
};

/// Baek et al. 2018 without polarisation.
struct PolarizedPlasticMaterial {
  double eta = 1.49 / 1.000277;
  ColorInput diffuse_reflectance = Spectrum(0.5f), specular_reflectance = Spectrum(1.0f);
  Roughness interface;
  bool operator==(const PolarizedPlasticMaterial&) const = default;
};

/// Mitsuba's filters for polarised light, which weaken light without polarisation.
enum class FilterKindOfLight { polarizer, retarder, circular };
struct FilterMaterial {
  FilterKindOfLight kind = FilterKindOfLight::polarizer;
  ColorInput transmittance = Spectrum(1.0f);
  bool operator==(const FilterMaterial&) const = default;
};

/// A clear coat over another material.
struct CoatingMaterial {
  double eta = 1.5046 / 1.000277, thickness = 1;
  ColorInput sigma_a = Spectrum(0.0f), specular_reflectance = Spectrum(1.0f);
  std::optional<Roughness> roughness;  ///< isotropic: alpha_v equals alpha_u
  MaterialId nested{};
  bool operator==(const CoatingMaterial&) const = default;
};

/// Single scattering in a layer of a medium: Hanrahan & Krueger 1993.
struct ThinLayerMaterial {
  ColorInput sigma_s = Spectrum(1.0f), sigma_a = Spectrum(0.0f);
  double thickness = 1, g = 0;
  bool operator==(const ThinLayerMaterial&) const = default;
};

struct TwoSidedMaterial {
  MaterialId front{}, back{};
  bool operator==(const TwoSidedMaterial&) const = default;
};

struct MaskMaterial {
  FloatInput opacity = 0.5;
  MaterialId nested{};
  bool operator==(const MaskMaterial&) const = default;
};

/// (1 − weight) · first + weight · second.
struct BlendMaterial {
  FloatInput weight = 0.5;
  MaterialId first{}, second{};
  bool operator==(const BlendMaterial&) const = default;
};

/// Σ weight · material; the weights are positive and sum to at most one.
struct MixtureMaterial {
  std::vector<std::pair<double, MaterialId>> parts;
  bool operator==(const MixtureMaterial&) const = default;
};

struct BumpMapMaterial {
  FloatInput height = 0.0;
  double scale = 1;
  bool flip_invalid_normals = true, use_shadowing_function = true;
  MaterialId nested{};
  bool operator==(const BumpMapMaterial&) const = default;
};

struct NormalMapMaterial {
  ColorInput normals = Spectrum(0.5f, 0.5f, 1.0f);  ///< (n + 1) / 2
  bool flip_invalid_normals = true, use_shadowing_function = true;
  MaterialId nested{};
  bool operator==(const NormalMapMaterial&) const = default;
};

struct NullMaterial {
  bool operator==(const NullMaterial&) const = default;
};

struct MaterialDescription {
  SourceLocation where;
  Label label;
  std::variant<DiffuseMaterial, ConductorMaterial, DielectricMaterial, ThinDielectricMaterial,
               PlasticMaterial, PrincipledMaterial, PrincipledThinMaterial, TwoSidedMaterial,
               MaskMaterial, BlendMaterial, BumpMapMaterial, NormalMapMaterial, NullMaterial,
               PhongMaterial, WardMaterial, RoughDiffuseMaterial, DiffuseTransmitterMaterial,
               MixtureMaterial, HairMaterial, MeasuredMaterial, PolarizedPlasticMaterial,
               FilterMaterial, CoatingMaterial, ThinLayerMaterial>
      model;
  bool operator==(const MaterialDescription&) const = default;
};

}  // namespace duet
