// BSDFs of a diffuse and a glossy lobe.
#pragma once

#include <array>

#include "materials/ward_variant.h"
#include "scene/material_model.h"

namespace duet {

namespace parameter_words {
inline constexpr Parameter kGlossyReflectance{"specular_reflectance", reflectance, kInitial,
                                              "of the glossy lobe"};
inline constexpr Parameter kDiffuseReflectance{"diffuse_reflectance", reflectance, kInitial,
                                               "of the diffuse lobe"};
}  // namespace parameter_words

struct PhongMaterial {
  FloatInput exponent = 30.0;
  ColorInput diffuse_reflectance = Spectrum(0.5f), specular_reflectance = Spectrum(0.2f);

  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using M = PhongMaterial;
    return FieldList(field(&M::exponent, Parameter{"exponent", number_or_texture, kInitial})
                         .shown(", exponent "),
                     field(&M::diffuse_reflectance, kDiffuseReflectance).shown(", diffuse "),
                     field(&M::specular_reflectance, kGlossyReflectance).shown(", specular "));
  }
  static constexpr const char* name() { return "phong"; }
  Scattering scattering() const { return {.diffuse = true, .rough_reflection = true}; }
  MaterialPointer build(SceneBuilder& b, const SourceLocation& where) const;
};

struct WardMaterial {
  WardVariant variant = WardVariant::balanced;
  FloatInput alpha_u = 0.1, alpha_v = 0.1;
  ColorInput diffuse_reflectance = Spectrum(0.5f), specular_reflectance = Spectrum(0.2f);

  static constexpr std::array<std::string_view, 3> kVariants{"ward", "ward-duer", "balanced"};
  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using M = WardMaterial;
    return FieldList(
        field(&M::variant, Parameter{"variant", string, kInitial, "ward, ward-duer or balanced"})
            .words(kVariants),
        field(&M::alpha_u, Parameter{"alpha_u", number_or_texture, kInitial, "along the tangent"})
            .shown(", alpha "),
        field(&M::alpha_v, Parameter{"alpha_v", number_or_texture, kInitial, "along the bitangent"})
            .shown(" and "),
        field(&M::diffuse_reflectance, kDiffuseReflectance).shown(", diffuse "),
        field(&M::specular_reflectance, kGlossyReflectance).shown(", specular "));
  }
  static constexpr const char* name() { return "ward"; }
  Scattering scattering() const { return {.diffuse = true, .rough_reflection = true}; }
  MaterialPointer build(SceneBuilder& b, const SourceLocation& where) const;
};

}  // namespace duet
