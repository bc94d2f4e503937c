// Reads triangle meshes from files.
#pragma once

#include <optional>
#include <string>

#include "base/diagnostics.h"
#include "geometry/mesh.h"

namespace duet {

/// How Mitsuba's mesh plugins interpret a file.
struct MeshOptions {
  /// Drop the file's normals and make none: the surface is faceted.
  bool face_normals = false;
  /// Turn v upside down (1 − v).
  bool flip_tex_coords = false;
  /// Rebuild normals; edges whose faces meet at a greater angle (degrees) stay sharp. Mitsuba 0.x.
  std::optional<double> max_smooth_angle;
  /// Which mesh of a .serialized file.
  int shape_index = 0;
};

/// Each throws ReadError with what is wrong and, for text formats, in which line. Meshes returned are
/// valid: indices in range, all numbers finite, normals and texture coordinates one per vertex or
/// none, attributes of the right length. A mesh without normals gets smooth ones unless
/// `face_normals` is set.
TriangleMesh read_obj(const std::string& file, const MeshOptions& options);
TriangleMesh read_ply(const std::string& file, const MeshOptions& options);
TriangleMesh read_serialized(const std::string& file, const MeshOptions& options);

}  // namespace duet
