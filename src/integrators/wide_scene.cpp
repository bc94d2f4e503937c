#include "integrators/wide_scene.h"

#include "materials/plain_diffuse.h"

namespace duet {

namespace {

/// Whether the shading frame at a point depends on the normal alone: that is the one that batches
/// have. Others are turned around it, which makes other paths of the same random numbers.
bool has_frame_of_normal(const Shape& shape) {
  if (shape.needs.tangents || shape.kind == ShapeKind::curves) return false;
  return shape.kind == ShapeKind::mesh || !shape.needs.uv;
}

}  // namespace

WideScene::WideScene(const Scene& s) : scene(s), lights(s) {
  shapes.reserve(s.shapes.size());
  for (const Shape& shape : s.shapes) {
    WideShape& w = shapes.emplace_back();
    const Material& material = *s.materials[shape.material];
    w.emits = shape.light != kNone;
    const auto diffuse = has_frame_of_normal(shape) ? as_diffuse(material) : std::nullopt;
    if (!diffuse) w.prefetched = material.main_texture();
    if (diffuse) {
      w.diffuse = true;
      w.two_sided = diffuse->two_sided;
      w.reflectance = diffuse->reflectance.constant;
      if (!diffuse->reflectance.is_constant()) w.textured = &diffuse->reflectance;
    }
    if (shape.kind != ShapeKind::mesh) continue;
    w.positions = shape.mesh->positions.data();
    w.triangles = shape.mesh->triangles.data();
    w.sign = shape.flip_normals ? -1.0f : 1.0f;
    if (shape.mesh->normals.empty()) continue;
    w.normals = shape.mesh->normals.data();
    has_normals = true;
  }
}

}  // namespace duet
