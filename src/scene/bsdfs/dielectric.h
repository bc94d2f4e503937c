// Transparent materials: solid ones, and panes.
#pragma once

#include "scene/bsdfs/parameters.h"
#include "scene/material_model.h"

namespace duet {

struct DielectricMaterial {
  FloatInput eta = 1.5046 / 1.000277;  ///< inside over outside
  ColorInput specular_reflectance = Spectrum(1.0f), specular_transmittance = Spectrum(1.0f);
  std::optional<Roughness> roughness;

  static constexpr auto fields() {
    using namespace parameter_words;
    using M = DielectricMaterial;
    return FieldList(field(&M::eta, kGlass, kExterior).shown(", eta "),
                     field(&M::specular_reflectance, kSpecularReflectance),
                     field(&M::specular_transmittance, kSpecularTransmittance),
                     roughness_field(&M::roughness));
  }
  const char* name() const { return roughness ? "roughdielectric" : "dielectric"; }
  Scattering scattering() const {
    return {.rough_refraction = roughness.has_value(), .smooth_glass = !roughness};
  }
  MaterialPointer build(SceneBuilder& b, const SourceLocation& where) const;
};

struct ThinDielectricMaterial {
  double eta = 1.5046 / 1.000277;
  ColorInput specular_reflectance = Spectrum(1.0f), specular_transmittance = Spectrum(1.0f);

  static constexpr auto fields() {
    using namespace parameter_words;
    using M = ThinDielectricMaterial;
    return FieldList(field(&M::eta, kGlass, kExterior).shown(", eta "),
                     field(&M::specular_reflectance, kSpecularReflectance),
                     field(&M::specular_transmittance, kSpecularTransmittance));
  }
  static constexpr const char* name() { return "thindielectric"; }
  Scattering scattering() const { return {.smooth_glass = true}; }
  MaterialPointer build(SceneBuilder& b, const SourceLocation& where) const;
};

}  // namespace duet
