// What plugins with a diffuse and a specular lobe have in common.
#pragma once

#include "mitsuba/scene_reader.h"

namespace duet::plugins {

/// Mitsuba 0.6 scales the two lobes of a material that would reflect more light than there is; with
/// a warning.
void conserve_energy(SceneReader& s, Properties& p, ColorInput& diffuse, ColorInput& specular);

}  // namespace duet::plugins
