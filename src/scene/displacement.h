// Meshes whose vertices a texture moves.
#pragma once

#include "scene/description.h"

namespace duet {

/// Replaces the meshes of shapes with MeshShape::displacement by displaced ones, which come from no
/// file. Throws std::runtime_error with the first error if one cannot be: its texture cannot be
/// read or has values on shapes alone, or there are too many triangles.
void displace_meshes(SceneDescription& scene);

}  // namespace duet
