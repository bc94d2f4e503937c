// The readers of shapes, in tables by what they have in common.
#pragma once

#include "pbrt/records.h"
#include "pbrt/shapes.h"
#include "pbrt/values.h"

namespace duet::pbrt {

using ReadShape = void (*)(Values&);

std::span<const Record<ReadShape>> quadric_shapes();
std::span<const Record<ReadShape>> mesh_shapes();
std::span<const Record<ReadShape>> curve_shapes();

/// Adds a mesh with what the state says of it, unless it has no triangles. `own_normals` as in
/// ShapeParts::has_normals.
void add_mesh(Values& v, TriangleMesh mesh, bool own_normals);

}  // namespace duet::pbrt
