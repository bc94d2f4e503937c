// A triangle mesh: what mesh files yield and what is rendered.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "math/transform.h"
#include "math/vector.h"

namespace duet {

/// Further data of a mesh by name, for the `mesh_attribute` texture.
struct MeshAttribute {
  std::string name;  ///< with its prefix "vertex_" or "face_"
  int channels = 3;  ///< 1 or 3
  bool per_face = false;
  std::vector<float> data;  ///< elements × channels
  bool operator==(const MeshAttribute&) const = default;
};

/// What bump maps take as the derivatives of the position on a mesh that has normals.
enum class BumpTangents : uint8_t {
  derivatives,     ///< those by the texture coordinates
  across_normals,  ///< pbrt-v4's: ∂p/∂u made perpendicular to the normal, and the normal × that
  unit_backwards,  ///< pbrt-v3's: the same turned round and made unit vectors, which inverts bumps
};

/// Vertices are shared by the triangles that name them. Arrays other than `positions` and
/// `triangles` may be empty; otherwise they have one entry per vertex.
struct TriangleMesh {
  std::vector<Point3f> positions;
  std::vector<Normal3f> normals;
  std::vector<Point2f> uvs;
  std::vector<std::array<uint32_t, 3>> triangles;
  std::vector<MeshAttribute> attributes;
  /// The normals were made from the faces: transform_mesh makes them again, because neither angles
  /// nor the side that a winding shows survive every transform.
  bool computed_normals = false;
  BumpTangents bump_tangents = BumpTangents::derivatives;

  bool operator==(const TriangleMesh&) const = default;
  const MeshAttribute* find_attribute(const std::string& name) const;
};

/// The normal with length one, whatever its scale; zero if it is zero or not finite.
Normal3f normalized_or_zero(const Normal3f& n);

/// Replaces the normals by the angle-weighted means of the faces around each vertex; a vertex
/// without a proper face gets a normal of zero. Sets `computed_normals`. Source: Thürmer &
/// Wüthrich, "Computing Vertex Normals from Polygonal Facets", 1998.
void compute_vertex_normals(TriangleMesh& mesh);

/// Makes one vertex of those that are equal in every array, and leaves out what no triangle uses.
void merge_equal_vertices(TriangleMesh& mesh);

/// Whether the vertex normals, which there are, say what the triangles say already.
bool has_flat_normals(const TriangleMesh& mesh);

/// Replaces the normals by smooth ones with creases: triangles that meet in a vertex share a normal
/// there only if their planes differ by less than `max_angle` degrees (compared with the first
/// triangle of each cluster, in file order). Vertices are merged and split as that needs; vertices
/// with different texture coordinates or attributes stay apart. This is Mitsuba 0.x's
/// `maxSmoothAngle`.
void compute_creased_normals(TriangleMesh& mesh, double max_angle);

/// Moves all vertices and normals to where `to_world` puts them. Triangles keep the order of their
/// vertices: after a mirroring transform these run counter-clockwise as seen from what was the
/// back, as in Mitsuba.
void transform_mesh(TriangleMesh& mesh, const Matrix4& to_world);

/// The cube with corners at ±1, with normals and texture coordinates per face.
TriangleMesh make_cube();
/// The rectangle from (−1, −1, 0) to (1, 1, 0), facing +z, with texture coordinates from 0 to 1.
TriangleMesh make_rectangle();

}  // namespace duet
