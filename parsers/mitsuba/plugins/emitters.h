// What the files about lights share.
#pragma once

#include "mitsuba/properties.h"

namespace duet::plugins {

/// Sun and sky (emitter_sky.cpp).
std::vector<Plugin> skies();

/// The share of the light in the choice of a light.
void read_weight(Properties& p, LightDescription& out);

}  // namespace duet::plugins
