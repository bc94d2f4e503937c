// Surfaces that light passes straight through.
#pragma once

#include <array>

#include "scene/material_model.h"

namespace duet {

struct NullMaterial {
  static constexpr auto fields() { return FieldList(); }
  static constexpr const char* name() { return "null"; }
  Scattering scattering() const { return {.see_through = true}; }
  MaterialPointer build(SceneBuilder& b, const SourceLocation& where) const;
};

/// Mitsuba's filters for polarised light, which weaken light without polarisation.
enum class FilterKindOfLight { polarizer, retarder, circular };
struct FilterMaterial {
  FilterKindOfLight kind = FilterKindOfLight::polarizer;
  ColorInput transmittance = Spectrum(1.0f);

  static constexpr std::array<const char*, 3> kKinds{"polarizer", "retarder", "circular"};
  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using M = FilterMaterial;
    return FieldList(field(&M::kind),
                     field(&M::transmittance, Parameter{"transmittance", reflectance, kInitial})
                         .shown(", transmittance "));
  }
  const char* name() const { return kKinds[size_t(kind)]; }
  Scattering scattering() const { return {.see_through = true}; }
  MaterialPointer build(SceneBuilder& b, const SourceLocation& where) const;
};

}  // namespace duet
