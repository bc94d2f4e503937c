// Builds shapes from their descriptions: meshes move to world space and lose what no material or
// light needs.
#include "scene/builder.h"

namespace duet {

namespace {

bool has_finite_positions(const TriangleMesh& mesh) {
  for (const Point3f& p : mesh.positions)
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return false;
  return true;
}

bool has_finite_points(const CurveSet& curves) {
  for (const auto& [p, radius] : curves.points)
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return false;
  return true;
}

/// Leaves out what neither the materials and lights nor the layers of the image read.
void strip(TriangleMesh& mesh, const SurfaceNeeds& needs, const std::set<ShapeTexture*>& textures) {
  if (!needs.uv && !needs.tangents) mesh.uvs = {};
  // Vertex normals that say what the triangles say already.
  if (!mesh.normals.empty() && has_flat_normals(mesh)) mesh.normals = {};
  std::erase_if(mesh.attributes, [&](const MeshAttribute& a) {
    for (const ShapeTexture* t : textures)
      if (t->reads_attribute(a.name)) return false;
    return true;
  });
}

}  // namespace

std::shared_ptr<TriangleMesh> SceneBuilder::world_mesh(ShapeDescription& d) {
  std::shared_ptr<TriangleMesh> mesh;
  if (auto* shape = std::get_if<MeshShape>(&d.geometry)) {
    // A mesh that nobody else holds is taken over; it was not made const.
    if (shape->mesh.use_count() == 1)
      mesh = std::const_pointer_cast<TriangleMesh>(std::move(shape->mesh));
    else
      mesh = std::make_shared<TriangleMesh>(*shape->mesh);
    shape->mesh.reset();
  } else {
    mesh = std::make_shared<TriangleMesh>(*own_triangles(d));
  }
  transform_mesh(*mesh, d.to_world);
  // Embree may read 4 bytes beyond the last vertex.
  mesh->positions.reserve(mesh->positions.size() + 1);
  return mesh;
}

void SceneBuilder::shapes() {
  Scene& scene = *scene_;
  size_t count = 0;
  const auto add_all = [&](std::vector<ShapeDescription>& descriptions) {
    const size_t first = scene.shapes.size();
    for (ShapeDescription& d : descriptions)
      if (!std::holds_alternative<InstanceShape>(d.geometry)) add_shape(d);
    return ShapeRange{uint32_t(first), uint32_t(scene.shapes.size() - first)};
  };
  for (const ShapeGroupDescription& g : description_.groups) count += g.shapes.size();
  for (const ShapeDescription& d : description_.shapes)
    count += !std::holds_alternative<InstanceShape>(d.geometry);
  scene.shapes.reserve(count);
  scene.top = add_all(description_.shapes);
  for (ShapeGroupDescription& g : description_.groups) scene.groups.push_back(add_all(g.shapes));
  scene.instances.reserve(description_.shapes.size() - scene.top.count);
  for (const ShapeDescription& d : description_.shapes)
    if (const auto* instance = std::get_if<InstanceShape>(&d.geometry))
      add_instance(d, instance->group);
}

void SceneBuilder::add_instance(const ShapeDescription& d, uint32_t group) {
  if (check_transform(d.to_world, d.where))
    scene_->instances.push_back(make_instance(group, d.to_world));
}

Instance SceneBuilder::make_instance(uint32_t group, const Matrix4& to_world) {
  // The Frobenius norm bounds the largest stretch.
  double squares = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) squares += to_world[i][size_t(j)] * to_world[i][size_t(j)];
  return {group, Transform(to_world), float(std::sqrt(squares))};
}

uint32_t SceneBuilder::shape_index(uint32_t described) const {
  // Instances come after all other shapes, which keep their order.
  uint32_t index = scene_->top.first;
  for (uint32_t i = 0; i < described; ++i)
    index += !std::holds_alternative<InstanceShape>(description_.shapes[i].geometry);
  return index;
}

Shape SceneBuilder::geometry(ShapeDescription& d, const SurfaceNeeds& needs) {
  Shape shape;
  shape.flip_normals = d.flip_normals;
  shape.needs = needs;
  if (std::holds_alternative<SphereShape>(d.geometry)) {
    shape.kind = ShapeKind::sphere;
  } else if (std::holds_alternative<DiskShape>(d.geometry)) {
    shape.kind = ShapeKind::disk;
  } else if (std::holds_alternative<CylinderShape>(d.geometry)) {
    shape.kind = ShapeKind::cylinder;
  } else if (const auto* sdf = std::get_if<SdfGridShape>(&d.geometry)) {
    shape.kind = ShapeKind::sdf_grid;
    shape.sdf = sdf->grid;
  } else if (const auto* tubes = std::get_if<CurvesShape>(&d.geometry)) {
    auto curves = std::make_shared<CurveSet>(*tubes->curves);
    transform_curves(*curves, d.to_world);
    if (!has_finite_points(*curves))
      diagnostics_.error(d.where, "the transform moves points beyond the range of numbers");
    shape.kind = ShapeKind::curves;
    shape.curves = std::move(curves);
  } else {
    auto mesh = world_mesh(d);
    if (!has_finite_positions(*mesh))
      diagnostics_.error(d.where, "the transform moves vertices beyond the range of numbers");
    strip(*mesh, shape.needs, shape_textures_);
    if (use_ == AccelUse::moving) movable_meshes_[scene_->shapes.size()] = mesh;
    shape.mesh = std::move(mesh);
  }
  if (!shape.mesh && !shape.curves) {
    shape.to_world = Transform(d.to_world);
    shape.to_local = *d.to_world.inverse();
  }
  return shape;
}

void SceneBuilder::add_shape(ShapeDescription& d) {
  if (!check_transform(d.to_world, d.where)) return;
  ShapeTextureSet outer = std::exchange(shape_textures_, {});
  const Material* made = material(d.material);
  SurfaceNeeds needs = options_.layer_needs;
  if (made) needs = needs | made->needs();
  if (d.emission) {
    const ColorSlot radiance = slot(d.emission->radiance);
    needs.uv |= radiance.needs_uv();
    emissions_.push_back({scene_->shapes.size(), radiance, d.emission->sampling_weight,
                          d.emission->directional, d.emission->side, d.emission->where});
  }
  Shape shape = geometry(d, needs);
  shape.material = materials_[size_t(d.material)].index;
  shape.interior = medium(d.interior);
  shape.exterior = medium(d.exterior);
  announce(shape, d);
  shape_textures_ = std::move(outer);
  scene_->shapes.push_back(std::move(shape));
}

void SceneBuilder::announce(const Shape& shape, const ShapeDescription& d) {
  // In Mitsuba 0.x a rectangle has no triangles.
  const bool is_mesh = shape.mesh && !std::holds_alternative<RectangleShape>(d.geometry);
  for (ShapeTexture* t : shape_textures_)
    if (const std::string lack = t->add_shape(shape, is_mesh); !lack.empty()) {
      diagnostics_.error(d.where, "this shape has no {}, which a texture on it reads", lack);
      lacks_texture_data_ = true;
    }
}

}  // namespace duet
