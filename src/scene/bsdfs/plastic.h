// A diffuse base under a dielectric coat.
#pragma once

#include "scene/bsdfs/parameters.h"
#include "scene/material_model.h"

namespace duet {

struct PlasticMaterial {
  double eta = 1.49 / 1.000277;
  ColorInput diffuse_reflectance = Spectrum(0.5f), specular_reflectance = Spectrum(1.0f);
  bool nonlinear = false;
  std::optional<Roughness> roughness;  ///< isotropic: alpha_v equals alpha_u

  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using M = PlasticMaterial;
    return FieldList(field(&M::eta, kPolymer, kExterior).shown(", eta "),
                     field(&M::diffuse_reflectance, kDiffuseBase).shown(", diffuse "),
                     field(&M::specular_reflectance, kSpecularReflectance),
                     field(&M::nonlinear, Parameter{"nonlinear", boolean, kInitial,
                                                    "colour shifts by scattering inside the "
                                                    "coating"}),
                     isotropic_roughness_field(&M::roughness));
  }
  const char* name() const { return roughness ? "roughplastic" : "plastic"; }
  Scattering scattering() const {
    return {.diffuse = true, .rough_reflection = roughness.has_value(), .mirror = !roughness};
  }
  MaterialPointer build(SceneBuilder& b, const SourceLocation& where) const;
};

/// Baek et al. 2018 without polarisation.
struct PolarizedPlasticMaterial {
  double eta = 1.49 / 1.000277;
  ColorInput diffuse_reflectance = Spectrum(0.5f), specular_reflectance = Spectrum(1.0f);
  Roughness interface;

  static constexpr auto fields() {
    using namespace parameter_words;
    using M = PolarizedPlasticMaterial;
    return FieldList(field(&M::eta, kPolymer, kExterior).shown(", eta "),
                     field(&M::diffuse_reflectance, kDiffuseBase).shown(", diffuse "),
                     field(&M::specular_reflectance, kSpecularReflectance),
                     roughness_field(&M::interface));
  }
  static constexpr const char* name() { return "pplastic"; }
  Scattering scattering() const { return {.diffuse = true, .rough_reflection = true}; }
  MaterialPointer build(SceneBuilder& b, const SourceLocation& where) const;
};

}  // namespace duet
