// Surfaces that scatter light in all directions: smooth ones, rough ones, and thin ones that let it
// through.
#pragma once

#include "scene/material_model.h"

namespace duet {

struct DiffuseMaterial {
  ColorInput reflectance = Spectrum(0.5f);

  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    return FieldList(
        field(&DiffuseMaterial::reflectance, Parameter{.name = "reflectance",
                                                       .type = ParameterType::reflectance,
                                                       .preset = kInitial,
                                                       .aliases = "diffuse_reflectance"})
            .shown(" "));
  }
  static constexpr const char* name() { return "diffuse"; }
  Scattering scattering() const { return {.diffuse = true}; }
  MaterialPointer build(SceneBuilder& b, const SourceLocation& where) const;
};

struct RoughDiffuseMaterial {
  ColorInput reflectance = Spectrum(0.5f);
  FloatInput alpha = 0.2;
  bool use_fast_approx = false;

  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using M = RoughDiffuseMaterial;
    return FieldList(
        field(&M::reflectance, Parameter{"reflectance", ParameterType::reflectance, kInitial})
            .shown(" "),
        field(&M::alpha, Parameter{"alpha", number_or_texture, kInitial,
                                   "roughness as that of a Beckmann distribution"})
            .shown(", alpha "),
        field(&M::use_fast_approx,
              Parameter{"use_fast_approx", boolean, kInitial, "without interreflection"}));
  }
  static constexpr const char* name() { return "roughdiffuse"; }
  Scattering scattering() const { return {.diffuse = true}; }
  MaterialPointer build(SceneBuilder& b, const SourceLocation& where) const;
};

struct DiffuseTransmitterMaterial {
  ColorInput transmittance = Spectrum(0.5f);

  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    return FieldList(field(&DiffuseTransmitterMaterial::transmittance,
                           Parameter{"transmittance", reflectance, kInitial})
                         .shown(" "));
  }
  static constexpr const char* name() { return "difftrans"; }
  Scattering scattering() const { return {.diffuse = true, .translucent = true}; }
  MaterialPointer build(SceneBuilder& b, const SourceLocation& where) const;
};

}  // namespace duet
