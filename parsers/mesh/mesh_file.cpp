#include "mesh/mesh_file.h"

#include <algorithm>
#include <map>
#include <stdexcept>

#include "mesh/formats.h"

namespace duet {

TriangleMesh read_obj(const std::string& file, const MeshOptions& options) {
  if (options.obj_part) return std::move(read_obj_parts(file, options).parts[0].mesh);
  return parse_file(
      file, [&](ByteReader& in) { return std::move(parse_obj(in, options, false).parts[0].mesh); });
}

ObjFile read_obj_parts(const std::string& file, const MeshOptions& options) {
  return parse_file(file, [&](ByteReader& in) { return parse_obj_parts(in, options); });
}

ObjFile parse_obj_parts(ByteReader& in, const MeshOptions& options) {
  ObjFile result = parse_obj(in, options, !options.collapse);
  if (!options.obj_part) return result;
  const size_t count = result.parts.size(), index = size_t(*options.obj_part);
  if (index >= count)
    in.fail("has {} part{}: there is none with index {}", count, count == 1 ? "" : "s", index);
  std::swap(result.parts[0], result.parts[index]);
  result.parts.resize(1);
  return result;
}

namespace {

bool can_join(const ObjPart& a, const ObjPart& b) {
  return a.material == b.material && a.mesh.normals.empty() == b.mesh.normals.empty() &&
         a.mesh.uvs.empty() == b.mesh.uvs.empty() &&
         a.mesh.computed_normals == b.mesh.computed_normals;
}

void append(TriangleMesh& to, const TriangleMesh& from) {
  const uint32_t first = uint32_t(to.positions.size());
  const auto add = [](auto& a, const auto& b) { a.insert(a.end(), b.begin(), b.end()); };
  add(to.positions, from.positions);
  add(to.normals, from.normals);
  add(to.uvs, from.uvs);
  for (const auto& [a, b, c] : from.triangles)
    to.triangles.push_back({first + a, first + b, first + c});
}

}  // namespace

std::vector<ObjPart> join_parts(std::vector<ObjPart> parts) {
  std::vector<ObjPart> result;
  std::map<std::string, std::vector<size_t>> by_material;  // indices into the result
  for (ObjPart& part : parts) {
    std::vector<size_t>& candidates = by_material[part.material];
    const auto found = std::find_if(candidates.begin(), candidates.end(),
                                    [&](size_t i) { return can_join(result[i], part); });
    if (found != candidates.end()) {
      append(result[*found].mesh, part.mesh);
      part.mesh = {};
    } else {
      candidates.push_back(result.size());
      result.push_back(std::move(part));
    }
  }
  return result;
}

TriangleMesh read_ply(const std::string& file, const MeshOptions& options) {
  return parse_file(file, [&](ByteReader& in) { return parse_ply(in, options); });
}

TriangleMesh read_ply(const std::string& name, std::span<const uint8_t> memory,
                      const MeshOptions& options) {
  ByteReader in(name, memory);
  return parse_ply(in, options);
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
  if (options.quads)
    for (const auto& quad : *options.quads)
      for (uint32_t v : quad)
        if (v >= vertices)
          in.fail("a face uses vertex {}, but there are only {} vertices", v, vertices);
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
    if (!options.only_own_normals) compute_vertex_normals(mesh);
  } else {
    for (Normal3f& n : mesh.normals) n = normalized_or_zero(n);
  }
}

Matrix4 recentering(const std::vector<const TriangleMesh*>& meshes) {
  double lower[3], upper[3];
  for (int i = 0; i < 3; ++i) lower[i] = HUGE_VAL, upper[i] = -HUGE_VAL;
  for (const TriangleMesh* mesh : meshes)
    for (const Point3f& p : mesh->positions)
      for (int i = 0; i < 3; ++i)
        lower[i] = std::min(lower[i], double(p[i])), upper[i] = std::max(upper[i], double(p[i]));
  return Matrix4::translate(-0.5 * (lower[0] + upper[0]), -0.5 * (lower[1] + upper[1]),
                            -0.5 * (lower[2] + upper[2]));
}

}  // namespace duet
