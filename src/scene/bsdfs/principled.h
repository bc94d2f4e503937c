// Burley's BSDFs, 2012 and 2015, as parametrised by Mitsuba 3.
#pragma once

#include "scene/material_model.h"

namespace duet {

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

  static constexpr auto fields();
  static constexpr const char* name() { return "principled"; }
  Scattering scattering() const;
  MaterialPointer build(SceneBuilder& b, const SourceLocation& where) const;
};

struct PrincipledThinMaterial {
  ColorInput base_color = Spectrum(0.5f);
  FloatInput roughness = 0.5, anisotropic = 0.0, spec_trans = 0.0, eta = 1.5, spec_tint = 0.0,
             sheen = 0.0, sheen_tint = 0.0, flatness = 0.0, diff_trans = 0.0;
  double spec_reflectance_sampling_rate = 1, spec_transmittance_sampling_rate = 1,
         diffuse_reflectance_sampling_rate = 1, diffuse_transmittance_sampling_rate = 1;

  static constexpr auto fields();
  static constexpr const char* name() { return "principledthin"; }
  Scattering scattering() const;
  MaterialPointer build(SceneBuilder& b, const SourceLocation& where) const;
};

namespace parameter_words {
constexpr Parameter principled_weight(std::string_view name, std::string_view note = "") {
  return {name, number_or_texture, kInitial, note};
}
constexpr Parameter sampling_rate(std::string_view name) {
  return {name, number, kInitial, "", not_negative};
}
}  // namespace parameter_words

constexpr auto PrincipledMaterial::fields() {
  using namespace parameter_words;
  using enum ParameterType;
  using M = PrincipledMaterial;
  return FieldList(
      field(&M::base_color, Parameter{"base_color", reflectance, kInitial}).shown(" "),
      field(&M::roughness, principled_weight("roughness")).shown(", roughness "),
      field(&M::anisotropic, principled_weight("anisotropic")),
      field(&M::metallic, principled_weight("metallic")).shown(", metallic "),
      field(&M::spec_trans, principled_weight("spec_trans")),
      field(&M::eta,
            Parameter{"eta", number, "", "index of refraction; either this or specular", positive})
          .when([](const M& m) { return !m.specular; }),
      field(&M::specular, Parameter{"specular", number, "0.5",
                                    "reflection at normal incidence, as Burley scales it"}),
      field(&M::spec_tint, principled_weight("spec_tint")),
      field(&M::sheen, principled_weight("sheen")),
      field(&M::sheen_tint, principled_weight("sheen_tint")),
      field(&M::flatness, principled_weight("flatness")),
      field(&M::clearcoat, principled_weight("clearcoat")),
      field(&M::clearcoat_gloss, principled_weight("clearcoat_gloss")),
      field(&M::diffuse_reflectance_sampling_rate,
            sampling_rate("diffuse_reflectance_sampling_rate")),
      field(&M::main_specular_sampling_rate, sampling_rate("main_specular_sampling_rate")),
      field(&M::clearcoat_sampling_rate, sampling_rate("clearcoat_sampling_rate")));
}

constexpr auto PrincipledThinMaterial::fields() {
  using namespace parameter_words;
  using enum ParameterType;
  using M = PrincipledThinMaterial;
  return FieldList(
      field(&M::base_color, Parameter{"base_color", reflectance, kInitial}).shown(" "),
      field(&M::roughness, principled_weight("roughness")).shown(", roughness "),
      field(&M::anisotropic, principled_weight("anisotropic")),
      field(&M::spec_trans, principled_weight("spec_trans")),
      field(&M::eta, principled_weight("eta")),
      field(&M::spec_tint, principled_weight("spec_tint")),
      field(&M::sheen, principled_weight("sheen")),
      field(&M::sheen_tint, principled_weight("sheen_tint")),
      field(&M::flatness, principled_weight("flatness")),
      field(&M::diff_trans,
            principled_weight("diff_trans", "from 0 (reflection) to 2 (transmission)")),
      field(&M::spec_reflectance_sampling_rate,
            sampling_rate("specular_reflectance_sampling_rate")),
      field(&M::spec_transmittance_sampling_rate,
            sampling_rate("specular_transmittance_sampling_rate")),
      field(&M::diffuse_reflectance_sampling_rate,
            sampling_rate("diffuse_reflectance_sampling_rate")),
      field(&M::diffuse_transmittance_sampling_rate,
            sampling_rate("diffuse_transmittance_sampling_rate")));
}

}  // namespace duet
