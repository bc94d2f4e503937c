// Sums of lobes that are each described by a colour, as pbrt-v3's materials have them. Neither
// Mitsuba has them.
#pragma once

#include "scene/bsdfs/parameters.h"
#include "scene/material_model.h"

namespace duet {

/// Any of: diffuse reflection and transmission, glossy reflection and transmission at a rough
/// dielectric interface, specular reflection and refraction at a smooth one; and `opacity` per
/// colour, which multiplies all of these and lets the rest of the light pass straight through. The
/// interfaces' Fresnel terms are those of `eta`. From below, all is the same with 1 / eta; glossy
/// reflection without transmission is the same with `eta`, too.
///
/// With the right colours black this is pbrt-v3's plastic, uber and translucent, and pbrt-v4's
/// diffusetransmission. Source: Pharr, Jakob, Humphreys, "Physically Based Rendering", 3rd ed.,
/// 2016, section 9.2.
struct UberMaterial {
  ColorInput diffuse_reflectance = Spectrum(0.25f), diffuse_transmittance = Spectrum(0.0f);
  ColorInput glossy_reflectance = Spectrum(0.25f), glossy_transmittance = Spectrum(0.0f);
  ColorInput specular_reflectance = Spectrum(0.0f), specular_transmittance = Spectrum(0.0f);
  ColorInput opacity = Spectrum(1.0f);
  FloatInput eta = 1.5;
  Roughness roughness;  ///< of the glossy lobes

  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using M = UberMaterial;
    return FieldList(
        field(&M::diffuse_reflectance, Parameter{"diffuse_reflectance", reflectance, kInitial})
            .shown(", diffuse "),
        field(&M::diffuse_transmittance, Parameter{"diffuse_transmittance", reflectance, kInitial})
            .shown(" and "),
        field(&M::glossy_reflectance, Parameter{"glossy_reflectance", reflectance, kInitial,
                                                "scales the reflection off the rough interface"})
            .shown(", glossy "),
        field(&M::glossy_transmittance, Parameter{"glossy_transmittance", reflectance, kInitial})
            .shown(" and "),
        field(&M::specular_reflectance, Parameter{"specular_reflectance", reflectance, kInitial,
                                                  "scales the reflection off the smooth interface"})
            .shown(", specular "),
        field(&M::specular_transmittance,
              Parameter{"specular_transmittance", reflectance, kInitial})
            .shown(" and "),
        field(&M::opacity, Parameter{"opacity", reflectance, kInitial, "the rest passes straight"})
            .shown(", opacity "),
        field(&M::eta, Parameter{"eta", number_or_texture, kInitial, "index inside over outside"}),
        roughness_field(&M::roughness));
  }
  static constexpr const char* name() { return "uber"; }
  Scattering scattering() const;
  MaterialPointer build(SceneBuilder& b, const SourceLocation& where) const;
};

/// A diffuse base under a glossy coat that takes the more of the light the lower it falls; only the
/// upper side scatters light.
struct SubstrateMaterial {
  ColorInput diffuse_reflectance = Spectrum(0.5f), specular_reflectance = Spectrum(0.5f);
  Roughness roughness;

  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using M = SubstrateMaterial;
    return FieldList(
        field(&M::diffuse_reflectance, Parameter{"diffuse_reflectance", reflectance, kInitial})
            .shown(" "),
        field(&M::specular_reflectance,
              Parameter{"specular_reflectance", reflectance, kInitial, "along the normal"})
            .shown(", specular "),
        roughness_field(&M::roughness));
  }
  static constexpr const char* name() { return "substrate"; }
  Scattering scattering() const { return {.diffuse = true, .rough_reflection = true}; }
  MaterialPointer build(SceneBuilder& b, const SourceLocation& where) const;
};

}  // namespace duet
