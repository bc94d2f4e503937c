// Reads triangle meshes from files.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "geometry/mesh.h"
#include "math/transform.h"

namespace duet {

/// Where Mitsuba 0.x and 3.x read the same file differently:
/// - OBJ: 0.x makes one vertex of equal ones, so that computed normals are smooth across them.
/// - PLY: 0.x takes 8-bit colours as [0, 1] and decodes colours from sRGB; 3.x takes unsigned 8-bit
///   numbers as they are and decodes other integers of at most 32 bits from sRGB.
/// - serialized: 0.x obeys the file's own flag for face normals, 3.x does not.
enum class MeshDialect { mitsuba0, mitsuba3 };

/// How Mitsuba's mesh plugins interpret a file.
struct MeshOptions {
  MeshDialect dialect = MeshDialect::mitsuba3;
  /// Drop the file's normals and make none: the surface is faceted.
  bool face_normals = false;
  /// Make no normals where the file has none: the surface is faceted there.
  bool only_own_normals = false;
  /// PLY: faces of four corners go here as they are, instead of becoming triangles. Not null
  /// together with attributes of faces.
  std::vector<std::array<uint32_t, 4>>* quads = nullptr;
  /// Turn v upside down (1 − v). Mitsuba's default is true for OBJ and false for PLY; serialized
  /// files have no such parameter.
  bool flip_tex_coords = false;
  /// Rebuild normals; edges whose faces meet at a greater angle (degrees) stay sharp. Mitsuba 0.x;
  /// not together with `face_normals`.
  std::optional<double> max_smooth_angle;
  /// PLY colours are sRGB. Mitsuba 0.x only (its `srgb`).
  bool srgb_colors = true;
  /// Which mesh of a .serialized file.
  int shape_index = 0;
  /// Only this part of an OBJ file, as 0.x divides it; see read_obj_parts().
  std::optional<int> obj_part;
  /// The whole OBJ file is one part, of the last material that it names (0.x's `collapse`).
  bool collapse = false;
};

/// Each throws ReadError "file: message", or "file:line: message" for text formats. Meshes returned
/// are valid: indices in range, all numbers finite, texture coordinates one per vertex or none,
/// normals likewise and of length one, or zero where the file has none of use and the face's own
/// normal counts; attributes of the right length. A mesh without normals gets smooth ones unless
/// `face_normals` is set. PLY and serialized files may have no triangles at all.
///
/// OBJ: all groups and materials are one mesh. Polygons become fans around their first vertex.
TriangleMesh read_obj(const std::string& file, const MeshOptions& options);
TriangleMesh read_ply(const std::string& file, const MeshOptions& options);
TriangleMesh read_serialized(const std::string& file, const MeshOptions& options);
/// From memory; `name` is used in messages.
TriangleMesh read_ply(const std::string& name, std::span<const uint8_t> memory,
                      const MeshOptions& options);

/// A stretch of an OBJ file between its `g` and `usemtl` lines.
struct ObjPart {
  std::string material;  ///< what the last `usemtl` says, or ""
  TriangleMesh mesh;
};
struct ObjFile {
  std::vector<ObjPart> parts;  ///< never empty
  std::string library;         ///< what the last `mtllib` says, or ""
};
/// Divides an OBJ file as Mitsuba 0.x does: normals are not smoothed across parts.
ObjFile read_obj_parts(const std::string& file, const MeshOptions& options);

/// Puts the parts of one material together, in the order of the materials' first parts. (Parts that
/// differ in whether they have texture coordinates or normals stay apart.)
std::vector<ObjPart> join_parts(std::vector<ObjPart> parts);

/// Moves the middle of the meshes' box to the origin.
Matrix4 recentering(const std::vector<const TriangleMesh*>& meshes);

}  // namespace duet
