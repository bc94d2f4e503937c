#include "mesh/mesh_file.h"

#include <algorithm>
#include <stdexcept>

#include "mesh/formats.h"

namespace duet {

TriangleMesh read_obj(const std::string& file, const MeshOptions& options) {
  if (options.obj_part)
    return parse_file(file, [&](ByteReader& in) {
      std::vector<ObjPart> parts = parse_obj(in, options, true);
      if (size_t(*options.obj_part) >= parts.size())
        in.fail("has {} part{}: there is none with index {}", parts.size(),
                parts.size() == 1 ? "" : "s", *options.obj_part);
      return std::move(parts[size_t(*options.obj_part)].mesh);
    });
  return parse_file(
      file, [&](ByteReader& in) { return std::move(parse_obj(in, options, false)[0].mesh); });
}

std::vector<ObjPart> read_obj_parts(const std::string& file, const MeshOptions& options) {
  return parse_file(file, [&](ByteReader& in) { return parse_obj(in, options, true); });
}

TriangleMesh read_ply(const std::string& file, const MeshOptions& options) {
  return parse_file(file, [&](ByteReader& in) { return parse_ply(in, options); });
}

TriangleMesh read_serialized(const std::string& file, const MeshOptions& options) {
  return parse_file(file, [&](ByteReader& in) { return parse_serialized(in, options); });
}

void finish_mesh(const ByteReader& in, const MeshOptions& options, TriangleMesh& mesh) {
  const size_t vertices = mesh.positions.size();
  for (size_t t = 0; t < mesh.triangles.size(); ++t)
    for (uint32_t v : mesh.triangles[t])
      if (v >= vertices)
        in.fail("triangle {} uses vertex {}, but there are only {} vertices", t, v, vertices);
  for (size_t v = 0; v < vertices; ++v)
    if (!is_finite(mesh.positions[v])) in.fail("the position of vertex {} is not finite", v);
  for (size_t v = 0; v < mesh.uvs.size(); ++v) {
    Point2f& uv = mesh.uvs[v];
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y))
      in.fail("the texture coordinates of vertex {} are not finite", v);
    if (options.flip_tex_coords) uv.y = 1 - uv.y;
  }
  for (const MeshAttribute& a : mesh.attributes)
    if (!std::all_of(a.data.begin(), a.data.end(), [](float x) { return std::isfinite(x); }))
      in.fail("attribute {} has numbers that are not finite", a.name);

  if (options.face_normals) {
    mesh.normals.clear();
  } else if (options.max_smooth_angle) {
    compute_creased_normals(mesh, *options.max_smooth_angle);
  } else if (mesh.normals.empty()) {
    compute_vertex_normals(mesh);
  } else {
    for (Normal3f& n : mesh.normals) n = normalized_or_zero(n);
  }
}

}  // namespace duet
