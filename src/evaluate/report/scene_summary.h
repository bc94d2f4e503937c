// What a scene file describes, in short, for people to read.
#pragma once

#include <string>

#include "evaluate/report/loaded_scene.h"

namespace duet {

/// Parameters, integrator, sensors, shapes, materials, textures and lights with their numbers, then
/// which features are modelled and what is approximated. Long lists are cut unless `all`.
std::string scene_summary(const LoadedScene& scene, bool all);

}  // namespace duet
