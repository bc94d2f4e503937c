// Parameters that several lights share.
#pragma once

#include "scene/field.h"

namespace duet::parameter_words {

inline constexpr Parameter kIntensity{"intensity", emission, kInitial, "radiant intensity, W/sr"};
inline constexpr Parameter kIrradiance{"irradiance", emission, kInitial};
inline constexpr Parameter kRadiance{
    .name = "radiance", .type = emission, .preset = kInitial, .aliases = "intensity"};
inline constexpr Parameter kLightScale{"scale", number, kInitial, "multiplies the light",
                                       not_negative};
inline constexpr Parameter kSamplingWeight{"sampling_weight", number, kInitial,
                                           "share in the choice of a light", not_negative};

}  // namespace duet::parameter_words
