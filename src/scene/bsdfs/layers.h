// Coats over other BSDFs, and thin layers of a medium.
#pragma once

#include "scene/bsdfs/parameters.h"
#include "scene/material_model.h"

namespace duet {

/// A clear coat over another material.
struct CoatingMaterial {
  double eta = 1.5046 / 1.000277, thickness = 1;
  ColorInput sigma_a = Spectrum(0.0f), specular_reflectance = Spectrum(1.0f);
  std::optional<Roughness> roughness;  ///< isotropic: alpha_v equals alpha_u
  MaterialId nested{};

  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using M = CoatingMaterial;
    return FieldList(
        field(&M::eta, kGlass, kExterior).shown(", eta "), field(&M::thickness, kThickness),
        field(&M::sigma_a, Parameter{"sigma_a", unbounded, kInitial, "absorption per thickness"}),
        field(&M::specular_reflectance, kSpecularReflectance),
        isotropic_roughness_field(&M::roughness), field(&M::nested));
  }
  const char* name() const { return roughness ? "roughcoating" : "coating"; }
  Scattering scattering() const {
    return {.rough_reflection = roughness.has_value(), .mirror = !roughness};
  }
  MaterialPointer build(SceneBuilder& b, const SourceLocation& where) const;
};

/// Single scattering in a layer of a medium: Hanrahan & Krueger 1993.
struct ThinLayerMaterial {
  ColorInput sigma_s = Spectrum(1.0f), sigma_a = Spectrum(0.0f);
  double thickness = 1;
  double g = 0;  ///< mean cosine of the scattering angle

  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using M = ThinLayerMaterial;
    return FieldList(
        field(&M::sigma_s, Parameter{"sigma_s", unbounded, "", "scattering coefficient"})
            .shown(", sigma_s ")
            .read_by_plugin(),
        field(&M::sigma_a, Parameter{"sigma_a", unbounded, "", "absorption coefficient"})
            .shown(", sigma_a ")
            .read_by_plugin(),
        field(&M::thickness, kThickness).shown(", thickness "), field(&M::g));
  }
  static constexpr const char* name() { return "hk"; }
  const char* loss() const { return g != 0 ? "the phase function of \"hk\" is missing" : ""; }
  Scattering scattering() const { return {.diffuse = true, .see_through = true}; }
  MaterialPointer build(SceneBuilder& b, const SourceLocation& where) const;
};

}  // namespace duet
