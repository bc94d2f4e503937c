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

/// Whether the shape of that name has the parameter.
bool shape_has(std::string_view shape, std::string_view parameter);

/// In v3 parameters of a shape's material may stand at the shape. Takes them out of it; the
/// material that they make of the current one. Nothing if there are none.
std::optional<MaterialId> take_material(Reader& reader, Plugin& shape);

/// Adds a mesh with what the state says of it, unless it has no triangles. `own_normals` as in
/// ShapeParts::has_normals.
void add_mesh(Values& v, TriangleMesh mesh, bool own_normals);

}  // namespace duet::pbrt
