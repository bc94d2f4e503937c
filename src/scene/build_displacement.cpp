// Meshes that a texture displaces become plain meshes before anything else looks at the shapes.
#include <stdexcept>

#include "geometry/edge_splitting.h"
#include "scene/builder.h"
#include "scene/displacement.h"

namespace duet {

namespace {

/// They take up some gigabytes.
constexpr size_t kMostTriangles = size_t(1) << 26;

bool is_displaced(const ShapeDescription& d) {
  const auto* shape = std::get_if<MeshShape>(&d.geometry);
  return shape && shape->displacement != FloatInput(0.0);
}

/// Moves the vertices along their normals by what `distance` says of a point, in the mesh's space.
void move_vertices(TriangleMesh& mesh, const Matrix4& to_world, const FloatSlot& distance) {
  if (mesh.normals.empty()) compute_vertex_normals(mesh);
  const Transform place(to_world);
  Surface point{};
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    point.position = place(mesh.positions[i]);
    if (!mesh.uvs.empty()) point.uv = mesh.uvs[i];
    mesh.positions[i] = mesh.positions[i] + Vector3f(mesh.normals[i]) * distance(point);
  }
  compute_vertex_normals(mesh);
  // They show the side that the winding had before the transform.
  mesh.computed_normals = false;
}

}  // namespace

void SceneBuilder::displace(ShapeDescription& d) {
  if (!is_displaced(d)) return;
  const MeshShape from = std::exchange(std::get<MeshShape>(d.geometry), MeshShape{});
  TriangleMesh mesh = *from.mesh;
  const FloatSlot distance = slot(from.displacement);
  const auto* id = std::get_if<TextureId>(&from.displacement);
  if (id && !textures_[size_t(*id)].shape_textures.empty()) {
    diagnostics_.error(description_.textures[size_t(*id)].where,
                       "the texture has values on shapes alone, and cannot displace one");
  } else if (split_long_edges(mesh, d.to_world, from.edge_length, kMostTriangles)) {
    move_vertices(mesh, d.to_world, distance);
  } else {
    diagnostics_.error(d.where, "with edges shorter than {} this mesh has more than {} triangles",
                       from.edge_length, kMostTriangles);
    mesh = *from.mesh;
  }
  std::get<MeshShape>(d.geometry).mesh = std::make_shared<TriangleMesh>(std::move(mesh));
}

void SceneBuilder::displace_meshes() {
  for_each_shape(description_, [&](ShapeDescription& d) { displace(d); });
}

void displace_meshes(SceneDescription& scene) {
  bool any = false;
  for_each_shape(scene, [&](const ShapeDescription& d) { any |= is_displaced(d); });
  if (!any) return;
  SceneBuilder builder(std::move(scene), {});
  builder.displace_meshes();
  if (builder.diagnostics().has_errors())
    throw std::runtime_error(builder.diagnostics().all().front().to_string());
  scene = builder.take_description();
}

}  // namespace duet
