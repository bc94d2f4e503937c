// Metals.
#pragma once

#include "scene/bsdfs/parameters.h"
#include "scene/material_model.h"

namespace duet {

/// `eta` and `k` are relative to the outside. A perfect mirror has eta = 0 and k = 1.
struct ConductorMaterial {
  ColorInput eta = Spectrum(0.0f), k = Spectrum(1.0f);
  ColorInput specular_reflectance = Spectrum(1.0f);
  std::optional<Roughness> roughness;

  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using M = ConductorMaterial;
    return FieldList(
        field(&M::eta, Parameter{"eta", unbounded, "(of the material)", "real part of the index"})
            .read_by_plugin(),
        field(&M::k, Parameter{"k", unbounded, "(of the material)", "imaginary part of the index"})
            .read_by_plugin(),
        field(&M::specular_reflectance, kSpecularReflectance), roughness_field(&M::roughness));
  }
  const char* name() const { return roughness ? "roughconductor" : "conductor"; }
  Scattering scattering() const {
    return {.rough_reflection = roughness.has_value(), .mirror = !roughness};
  }
  MaterialPointer build(SceneBuilder& b, const SourceLocation& where) const;
};

}  // namespace duet
