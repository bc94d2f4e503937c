// What hair of a certain colour absorbs.
#pragma once

#include "math/spectrum.h"

namespace duet {

/// Absorption per radius with which many hairs have this colour. Source: Chiang et al. 2016 (see
/// HairModel), equation 9.
Spectrum hair_absorption_for(const Spectrum& color, float azimuthal_roughness);

}  // namespace duet
