// Parameters that several BSDFs share.
#pragma once

#include "scene/parameter.h"

namespace duet::parameter_words {

inline constexpr Parameter kSpecularReflectance{"specular_reflectance", reflectance, kInitial,
                                                "scales the reflection; 1 is physical"};
inline constexpr Parameter kSpecularTransmittance{"specular_transmittance", reflectance, kInitial,
                                                  "scales the refraction; 1 is physical"};
inline constexpr Parameter kExterior{"ext_ior", ior, "air", "index of refraction outside"};
inline constexpr Parameter kGlass{"int_ior", ior, "bk7", "index of refraction inside"};
inline constexpr Parameter kPolymer{"int_ior", ior, "polypropylene", "index of refraction inside"};
/// Of the base under a coat.
inline constexpr Parameter kDiffuseBase{"diffuse_reflectance", reflectance, kInitial,
                                        "of the base under the coating"};
inline constexpr Parameter kThickness{"thickness", number, kInitial, "of the layer", not_negative};

}  // namespace duet::parameter_words
