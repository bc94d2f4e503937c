// Named metals of pbrt-v4.
#pragma once

#include <span>
#include <string_view>

#include "math/spectrum.h"

namespace duet::pbrt {

/// Index and extinction per colour channel with which the Fresnel reflectance is nearest, over all
/// angles, to the colour that pbrt's spectra have under the white of sRGB. Reflectances above one,
/// of gold's red, are one.
struct Metal {
  std::string_view name;
  Spectrum eta, k;
};
std::span<const Metal> measured_metals();

}  // namespace duet::pbrt
