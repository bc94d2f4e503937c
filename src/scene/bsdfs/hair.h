// Fibres.
#pragma once

#include "scene/bsdfs/parameters.h"
#include "scene/material_model.h"

namespace duet {

/// Chiang et al. 2016, as parametrised by Mitsuba 3; absorption is per radius.
struct HairMaterial {
  FloatInput longitudinal_roughness = 0.3, azimuthal_roughness = 0.3;
  FloatInput scale_tilt = 2.0;  ///< in degrees
  FloatInput eta = 1.55 / 1.000277;
  /// Concentrations, unless one of the next two is given.
  FloatInput eumelanin = 1.3, pheomelanin = 0.2;
  std::optional<ColorInput> sigma_a, reflectance;
  double scale = 1;  ///< of sigma_a

  static constexpr auto fields() {
    using namespace parameter_words;
    using enum ParameterType;
    using M = HairMaterial;
    constexpr auto pigments = [](const M& m) { return !m.sigma_a && !m.reflectance; };
    return FieldList(
        field(&M::longitudinal_roughness,
              Parameter{"longitudinal_roughness", number_or_texture, kInitial, "", fraction})
            .shown(", roughness "),
        field(&M::azimuthal_roughness,
              Parameter{"azimuthal_roughness", number_or_texture, kInitial, "", fraction})
            .shown(" and "),
        field(&M::scale_tilt, Parameter{"scale_tilt", number_or_texture, kInitial,
                                        "angle of the scales in degrees"}),
        field(&M::eta, Parameter{"int_ior", ior, "amber", "index of refraction inside"}, kExterior),
        field(&M::eumelanin,
              Parameter{"eumelanin", number_or_texture, kInitial, "concentration", not_negative})
            .shown(", eumelanin ")
            .when(pigments),
        field(&M::pheomelanin,
              Parameter{"pheomelanin", number_or_texture, kInitial, "concentration", not_negative})
            .shown(", pheomelanin ")
            .when(pigments),
        field(&M::sigma_a,
              Parameter{"sigma_a", unbounded, "", "absorption per radius, instead of pigments"})
            .shown(", sigma_a "),
        field(&M::scale, Parameter{"scale", number, kInitial, "multiplies sigma_a", not_negative})
            .when([](const M& m) { return m.sigma_a.has_value(); }),
        field(&M::reflectance, Parameter{"reflectance", ParameterType::reflectance, "",
                                         "colour of many hairs, instead of pigments: Duet's own"})
            .shown(", reflectance "));
  }
  static constexpr const char* name() { return "hair"; }
  Scattering scattering() const { return {.rough_reflection = true, .translucent = true}; }
  const char* loss() const;
  MaterialPointer build(SceneBuilder& b, const SourceLocation& where) const;
};

}  // namespace duet
