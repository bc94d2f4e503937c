// Writes triangle meshes as PLY files.
#pragma once

#include <string>

#include "geometry/mesh.h"

namespace duet {

/// A binary, little-endian file with x y z, normals (nx ny nz) and texture coordinates (u v) as far
/// as the mesh has them, and triangles as `vertex_indices`. Attributes are left out. Equal meshes
/// give equal bytes; read_ply() with `only_own_normals` yields the mesh again.
std::string ply_bytes(const TriangleMesh& mesh);

}  // namespace duet
