// What the fuzz targets of the mesh readers share.
#pragma once

#include <cmath>
#include <cstdlib>

#include "mesh/formats.h"

namespace duet::test {

inline void require(bool condition) {
  if (!condition) std::abort();
}

/// Aborts unless the mesh keeps the promises of mesh_file.h.
inline void check_mesh(const TriangleMesh& mesh) {
  const size_t vertices = mesh.positions.size();
  for (const auto& t : mesh.triangles)
    for (uint32_t v : t) require(v < vertices);
  for (const Point3f& p : mesh.positions) require(is_finite(p));
  require(mesh.uvs.empty() || mesh.uvs.size() == vertices);
  for (const Point2f& uv : mesh.uvs) require(std::isfinite(uv.x) && std::isfinite(uv.y));
  require(mesh.normals.empty() || mesh.normals.size() == vertices);
  for (const Normal3f& n : mesh.normals)
    require(n == Normal3f{} || std::abs(length(n) - 1) < 1e-5f);
  for (const MeshAttribute& a : mesh.attributes) {
    require(a.channels == 1 || a.channels == 3);
    require(a.data.size() == size_t(a.channels) * (a.per_face ? mesh.triangles.size() : vertices));
    for (float x : a.data) require(std::isfinite(x));
  }
}

/// Takes options from the first byte and reads the rest; a ReadError is a good outcome.
template <class Read>
int fuzz_mesh(const uint8_t* data, size_t size, Read read) {
  if (size == 0) return 0;
  MeshOptions options;
  options.dialect = data[0] & 1 ? MeshDialect::mitsuba0 : MeshDialect::mitsuba3;
  options.face_normals = data[0] & 2;
  options.flip_tex_coords = data[0] & 4;
  if (data[0] & 8) options.max_smooth_angle = 30;
  options.shape_index = data[0] & 16 ? 1 : 0;
  options.srgb_colors = data[0] & 32;
  try {
    ByteReader in("fuzz", {data + 1, size - 1});
    read(in, options);
  } catch (const ReadError&) {
  }
  return 0;
}

}  // namespace duet::test
