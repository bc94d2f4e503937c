// What lies behind mesh_file.h: readers of an opened file, and what they have in common.
#pragma once

#include "mesh/byte_reader.h"
#include "mesh/mesh_file.h"

namespace duet {

/// One part unless it is to be divided.
ObjFile parse_obj(ByteReader& in, const MeshOptions& options, bool divide);
/// The parts that the options ask for.
ObjFile parse_obj_parts(ByteReader& in, const MeshOptions& options);
TriangleMesh parse_ply(ByteReader& in, const MeshOptions& options);
TriangleMesh parse_serialized(ByteReader& in, const MeshOptions& options);

/// What all formats end with: checks indices and numbers, turns v upside down, normalises or makes
/// normals.
void finish_mesh(const ByteReader& in, const MeshOptions& options, TriangleMesh& mesh);

}  // namespace duet
