// Surfaces that volumes of distances describe.
#pragma once

#include <string>

#include "media/volume_grid.h"
#include "scene/description.h"

namespace duet {

/// Where the distances in the volume are zero, with smooth normals. Throws ReadError, whose message
/// begins with `name`, if it has more than one channel, too few or too many nodes, or no surface.
SdfGrid surface_of(const VolumeGrid& volume, const std::string& name);

}  // namespace duet
