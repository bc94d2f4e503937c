// Meshes made finer.
#pragma once

#include <cstddef>

#include "geometry/mesh.h"

namespace duet {

/// Splits edges in the middle, the longest one of a triangle first, until all are shorter than
/// `length` where `to_world` puts them. Triangles that share an edge share its new vertex, so that
/// nothing gapes; its texture coordinates are the mean of those of its ends, its normal the
/// normalised mean. Attributes are left out. False, with a mesh of no use, if there were more than
/// `most` triangles.
bool split_long_edges(TriangleMesh& mesh, const Matrix4& to_world, double length, size_t most);

}  // namespace duet
