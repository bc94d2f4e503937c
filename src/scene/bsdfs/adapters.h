// BSDFs that are made of others.
#pragma once

#include "scene/material_model.h"

namespace duet {

struct TwoSidedMaterial {
  MaterialId front{}, back{};

  static constexpr auto fields() {
    using M = TwoSidedMaterial;
    return FieldList(field(&M::front).shown("front "),
                     field(&M::back).shown("back ").optional().when(
                         [](const M& m) { return m.back != m.front; }));
  }
  static constexpr const char* name() { return "twosided"; }
  Scattering scattering() const { return {}; }
  MaterialPointer build(SceneBuilder& b, const SourceLocation& where) const;
};

struct MaskMaterial {
  FloatInput opacity = 0.5;
  MaterialId nested{};

  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using M = MaskMaterial;
    return FieldList(
        field(&M::opacity, Parameter{"opacity", number_or_texture, kInitial}).shown(", opacity "),
        field(&M::nested));
  }
  static constexpr const char* name() { return "mask"; }
  Scattering scattering() const { return {.see_through = true}; }
  MaterialPointer build(SceneBuilder& b, const SourceLocation& where) const;
};

/// (1 − weight) · first + weight · second.
struct BlendMaterial {
  FloatInput weight = 0.5;
  MaterialId first{}, second{};

  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using M = BlendMaterial;
    return FieldList(field(&M::weight, Parameter{"weight", number_or_texture, kInitial,
                                                 "share of the second material, from 0 to 1"})
                         .shown(", weight "),
                     field(&M::first), field(&M::second));
  }
  static constexpr const char* name() { return "blendbsdf"; }
  Scattering scattering() const { return {}; }
  MaterialPointer build(SceneBuilder& b, const SourceLocation& where) const;
};

/// Σ weight · material; the weights are positive and sum to at most one.
struct MixtureMaterial {
  MaterialShares parts;

  static constexpr auto fields() {
    return FieldList(field(&MixtureMaterial::parts, Parameter{"weights", ParameterType::string, "",
                                                              "numbers, separated by commas"})
                         .read_by_plugin());
  }
  static constexpr const char* name() { return "mixturebsdf"; }
  Scattering scattering() const { return {}; }
  MaterialPointer build(SceneBuilder& b, const SourceLocation& where) const;
};

namespace parameter_words {
inline constexpr Parameter kFlipInvalidNormals{
    .name = "flip_invalid_normals", .type = boolean, .preset = kInitial, .versions = v3};
inline constexpr Parameter kUseShadowingFunction{.name = "use_shadowing_function",
                                                 .type = boolean,
                                                 .preset = kInitial,
                                                 .versions = v3,
                                                 .preset_0x = "false"};
inline constexpr Parameter kDropsLeaks{
    .name = "drops_leaks",
    .type = boolean,
    .preset = kInitial,
    .note =
        "Duet's own: light that the surface has on another side than the perturbed normal is "
        "lost; pbrt lets it through"};
inline constexpr Parameter kFollowsCurvature{
    .name = "follows_curvature",
    .type = boolean,
    .preset = kInitial,
    .note =
        "Duet's own: bumps on curved surfaces as in pbrt, where the height also stretches them"};
}  // namespace parameter_words

struct BumpMapMaterial {
  FloatInput height = 0.0;
  double scale = 1;
  bool flip_invalid_normals = true, use_shadowing_function = true;
  bool drops_leaks = true;         ///< see TiltOptions
  bool follows_curvature = false;  ///< see BumpMap
  MaterialId nested{};

  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using M = BumpMapMaterial;
    return FieldList(field(&M::height).shown(" ").read_by_plugin(),
                     field(&M::scale, Parameter{.name = "scale",
                                                .type = number,
                                                .preset = kInitial,
                                                .note = "multiplies the height",
                                                .versions = v3}),
                     field(&M::flip_invalid_normals, kFlipInvalidNormals),
                     field(&M::use_shadowing_function, kUseShadowingFunction),
                     field(&M::drops_leaks, kDropsLeaks).terse(),
                     field(&M::follows_curvature, kFollowsCurvature).terse(), field(&M::nested));
  }
  static constexpr const char* name() { return "bumpmap"; }
  Scattering scattering() const { return {.bumps = true}; }
  MaterialPointer build(SceneBuilder& b, const SourceLocation& where) const;
};

struct NormalMapMaterial {
  ColorInput normals = Spectrum(0.5f, 0.5f, 1.0f);  ///< (n + 1) / 2
  bool flip_invalid_normals = true, use_shadowing_function = true;
  bool drops_leaks = true;  ///< see TiltOptions
  MaterialId nested{};

  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using M = NormalMapMaterial;
    Parameter flip = kFlipInvalidNormals;
    flip.preset_0x = "false";
    return FieldList(field(&M::normals, Parameter{.name = "normalmap",
                                                  .type = reflectance,
                                                  .note = "(n + 1) / 2; may be nameless in 0.x"})
                         .shown(" ")
                         .read_by_plugin(),
                     field(&M::flip_invalid_normals, flip),
                     field(&M::use_shadowing_function, kUseShadowingFunction),
                     field(&M::drops_leaks, kDropsLeaks).terse(), field(&M::nested));
  }
  static constexpr const char* name() { return "normalmap"; }
  Scattering scattering() const { return {.bumps = true}; }
  MaterialPointer build(SceneBuilder& b, const SourceLocation& where) const;
};

}  // namespace duet
