// A dielectric coat over a base with a layer of a medium between them, as pbrt-v4 has it: light
// goes to and fro between the two. Neither Mitsuba has such a BSDF.
#pragma once

#include "scene/bsdfs/parameters.h"
#include "scene/material_model.h"

namespace duet {

namespace parameter_words {
inline constexpr Parameter kCoatIndex{"eta", number, kInitial,
                                      "index of the coat over the outside's", positive};
inline constexpr Parameter kCoatAlphaU{"alpha_u", number_or_texture, kInitial,
                                       "roughness of the coat; below 0.001 it is smooth"};
inline constexpr Parameter kCoatAlphaV{"alpha_v", number_or_texture, kInitial};
inline constexpr Parameter kGap{"thickness", number_or_texture, kInitial,
                                "optical thickness between coat and base"};
inline constexpr Parameter kGapAlbedo{"albedo", reflectance, kInitial, "of the medium in between"};
inline constexpr Parameter kGapG{"g", number_or_texture, kInitial, "mean cosine of its scattering"};
inline constexpr Parameter kGapDepth{"max_depth", number, kInitial,
                                     "events between coat and base that are followed", positive};
inline constexpr Parameter kGapWalks{
    "samples", number, kInitial, "random walks per value, where there is no closed form", positive};
}  // namespace parameter_words

/// What both coats have: α of a correlated GGX distribution, and the layer under it. Only the upper
/// side scatters light.
struct CoatLayer {
  double eta = 1.5;  ///< over that of the outside
  FloatInput alpha_u = 0.0, alpha_v = 0.0;
  /// Optical: every crossing lets exp(−thickness / |cos θ|) pass, even where the albedo is zero.
  FloatInput thickness = 0.01;
  ColorInput albedo = Spectrum(0.0f);
  FloatInput g = 0.0;
  double max_depth = 10, samples = 1;  ///< whole numbers

  static constexpr auto layer_fields() {
    using namespace parameter_words;
    using L = CoatLayer;
    return FieldList(field(&L::eta, kCoatIndex).shown(", eta "),
                     field(&L::alpha_u, kCoatAlphaU).shown(", alpha "),
                     field(&L::alpha_v, kCoatAlphaV).shown(" and "),
                     field(&L::thickness, kGap).shown(", thickness "),
                     field(&L::albedo, kGapAlbedo).shown(", albedo "), field(&L::g, kGapG),
                     field(&L::max_depth, kGapDepth), field(&L::samples, kGapWalks));
  }
  /// Where the roughness is a texture, it is taken for rough.
  bool is_smooth() const;
};

/// Over a diffuse base.
struct CoatedDiffuseMaterial : CoatLayer {
  ColorInput reflectance = Spectrum(0.5f);

  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    return joined_fields(FieldList(field(&CoatedDiffuseMaterial::reflectance,
                                         Parameter{"reflectance", ParameterType::reflectance,
                                                   kInitial, "of the base"})
                                       .shown(" ")),
                         layer_fields());
  }
  static constexpr const char* name() { return "coateddiffuse"; }
  Scattering scattering() const;
  MaterialPointer build(SceneBuilder& b, const SourceLocation& where) const;
};

/// Over a metal. Its indices are relative to the outside; a perfect mirror has conductor_eta = 0.
struct CoatedConductorMaterial : CoatLayer {
  ColorInput conductor_eta = Spectrum(0.0f), conductor_k = Spectrum(1.0f);
  /// The metal's colour instead of its indices: η = 1 and k = 2 √r / √(1 − r) have the reflectance
  /// r at normal incidence.
  std::optional<ColorInput> reflectance;
  FloatInput conductor_alpha_u = 0.0, conductor_alpha_v = 0.0;

  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using M = CoatedConductorMaterial;
    constexpr auto has_index = [](const M& m) { return !m.reflectance; };
    return joined_fields(
        FieldList(
            field(&M::conductor_eta,
                  Parameter{"conductor_eta", unbounded, kInitial, "index of the metal"})
                .shown(" ")
                .when(has_index),
            field(&M::conductor_k, Parameter{"conductor_k", unbounded, kInitial})
                .shown(" and ")
                .when(has_index),
            field(&M::reflectance, Parameter{"reflectance", ParameterType::reflectance, "",
                                             "of the metal along the normal, instead of its index"})
                .shown(" "),
            field(&M::conductor_alpha_u,
                  Parameter{"conductor_alpha_u", number_or_texture, kInitial,
                            "roughness of the metal; below 0.001 it is smooth"})
                .shown(", metal alpha "),
            field(&M::conductor_alpha_v,
                  Parameter{"conductor_alpha_v", number_or_texture, kInitial})
                .shown(" and ")),
        layer_fields());
  }
  static constexpr const char* name() { return "coatedconductor"; }
  Scattering scattering() const;
  MaterialPointer build(SceneBuilder& b, const SourceLocation& where) const;
};

}  // namespace duet
