// Shapes as pbrt-v4 writes them.
#include <cmath>

#include "pbrt/scene_writer.h"
#include "pbrt/shapes.h"

namespace duet::pbrt {

namespace {

/// The numbers of points, normals or texture coordinates.
template <class T>
std::vector<float> components(const std::vector<T>& values) {
  std::vector<float> out;
  for (const T& v : values) {
    out.push_back(v.x);
    out.push_back(v.y);
    if constexpr (requires { v.z; }) out.push_back(v.z);
  }
  return out;
}

/// The unit disk with the texture coordinates that the description has: from the middle outwards,
/// and around.
TriangleMesh disk_with_uvs() {
  TriangleMesh mesh = make_disk(1, 0, 0, 360);
  for (Point2f& uv : mesh.uvs) uv = {1 - uv.y, uv.x};
  return mesh;
}

/// pbrt's shape whose parameters hold the transform; nothing if they cannot.
std::optional<Statement> quadric(const ShapeDescription& s, const Matrix4& m) {
  const double r = m[0][0], h = m[2][2], z = m[2][3];
  if (!(m == Matrix4::translate(0, 0, z) * Matrix4::scale(r, r, h)) || !(r > 0) || !(h > 0))
    return std::nullopt;
  const auto named = [&](std::string_view name) {
    Statement shape("Shape", name);
    if (r != 1) shape.number("radius", r);
    return shape;
  };
  if (std::holds_alternative<CylinderShape>(s.geometry))
    return named("cylinder").number("zmin", z).number("zmax", z + h);
  if (std::holds_alternative<DiskShape>(s.geometry))
    return z == 0 ? named("disk") : named("disk").number("height", z);
  if (!std::holds_alternative<SphereShape>(s.geometry) || z != 0 || r != h) return std::nullopt;
  return named("sphere");
}

TriangleMesh moved(TriangleMesh mesh, const Matrix4& by) {
  if (!(by == Matrix4{})) transform_mesh(mesh, by);
  return mesh;
}

constexpr std::string_view kStraight =
    "a shape away from its own origin moves straight ahead where it should turn";

bool has_own_normals(const ShapeDescription& s) {
  const auto* mesh = std::get_if<MeshShape>(&s.geometry);
  return std::holds_alternative<RectangleShape>(s.geometry) ||
         std::holds_alternative<CubeShape>(s.geometry) || (mesh && !mesh->mesh->normals.empty());
}

/// Whether ReverseOrientation is needed, where the transform of pbrt's own shape is `to_world`.
bool is_reversed(const ShapeDescription& s, const Matrix4& to_world, bool has_normals) {
  const bool mirrored = to_world.determinant3() < 0;
  bool reverse = s.flip_normals != (mirrored && !has_normals);
  // The sphere of the description keeps its outside under mirroring transforms; pbrt's lies upside
  // down in it.
  if (std::holds_alternative<SphereShape>(s.geometry)) reverse = s.flip_normals != true;
  // Normals of faces are on the side that the winding shows in the world.
  const auto* mesh = std::get_if<MeshShape>(&s.geometry);
  if (mesh && mesh->mesh->computed_normals && mirrored) reverse = !reverse;
  return reverse;
}

template <class T>
bool is_texture(const T& input) {
  return std::holds_alternative<TextureId>(input);
}

bool is_turned(const Roughness& r) {
  return is_texture(r.alpha_u) || is_texture(r.alpha_v) || r.alpha_u != r.alpha_v;
}

/// Whether the BSDF itself asks for texture coordinates, or for the directions along which they
/// change.
bool asks_for_uv(const MaterialModel& model) {
  bool found = false;
  const auto look = [&]<class T>(const T& value) {
    if constexpr (std::is_same_v<T, ColorInput> || std::is_same_v<T, FloatInput>)
      found |= is_texture(value);
    else if constexpr (std::is_same_v<T, std::optional<ColorInput>>)
      found |= value && is_texture(*value);
    else if constexpr (std::is_same_v<T, Roughness>)
      found |= is_turned(value);
    else if constexpr (std::is_same_v<T, std::optional<Roughness>>)
      found |= value && is_turned(*value);
  };
  model.for_each_field(
      [&](const FieldFacts&, const FieldValue& value) { with_value(value, look); });
  return found;
}

}  // namespace

bool SceneWriter::looks_at_uv(const ShapeDescription& s) const {
  return holds(d_, s.material, asks_for_uv) ||
         (s.emission && std::holds_alternative<TextureId>(s.emission->radiance));
}

void SceneWriter::place(std::string& out, const Matrix4& to_world, const Motion& motion) {
  if (motion.empty()) {
    if (!(to_world == Matrix4{})) out += transform_text(to_world);
    return;
  }
  out += "ActiveTransform StartTime\n" + transform_text(motion.keyframes().front().pose * to_world);
  out += "ActiveTransform EndTime\n" + transform_text(motion.keyframes().back().pose * to_world);
  out += "ActiveTransform All\n";
}

void SceneWriter::trianglemesh(const TriangleMesh& m, const FloatInput& alpha) {
  Statement s("Shape", "trianglemesh");
  std::vector<uint32_t> indices;
  for (const auto& t : m.triangles) indices.insert(indices.end(), t.begin(), t.end());
  s.list<uint32_t>("indices", Type::integer, indices);
  s.list<float>("P", Type::point3, components(m.positions));
  if (!m.normals.empty()) s.list<float>("N", Type::normal, components(m.normals));
  if (!m.uvs.empty()) s.list<float>("uv", Type::point2, components(m.uvs));
  if (alpha != FloatInput(1.0)) put(s, "alpha", alpha);
  world_text_ += s.text();
}

void SceneWriter::mesh(const MeshShape& m, const FloatInput& alpha, const Matrix4& own) {
  const bool displaced = m.displacement != FloatInput(0.0);
  if (m.source->pbrt_file.empty() || !(own == Matrix4{})) {
    if (displaced) lose("a displaced mesh that moves is not displaced");
    return trianglemesh(moved(*m.mesh, own), alpha);
  }
  Statement s("Shape", "plymesh");
  s.string("filename", m.source->pbrt_file);
  if (displaced) {
    put(s, "displacement", m.displacement);
    s.number("edgelength", m.edge_length);
  }
  if (alpha != FloatInput(1.0)) put(s, "alpha", alpha);
  world_text_ += s.text();
}

void SceneWriter::geometry(const ShapeDescription& s, const FloatInput& alpha, const Matrix4& own) {
  const auto* m = std::get_if<MeshShape>(&s.geometry);
  const auto is_bumpy = [](const MaterialModel& b) { return b.is<BumpMapMaterial>(); };
  if (has_own_normals(s) && !(m && m->mesh->bump_tangents == BumpTangents::across_normals) &&
      holds(d_, s.material, is_bumpy))
    lose("bumps on meshes with normals have the tangents of pbrt-v4");
  if (m) {
    if (m->mesh->uvs.empty() && looks_at_uv(s))
      lose("texture coordinates of meshes that have none are those of pbrt");
    return mesh(*m, alpha, own);
  }
  if (std::holds_alternative<RectangleShape>(s.geometry))
    return trianglemesh(moved(make_rectangle(), own), alpha);
  if (std::holds_alternative<CubeShape>(s.geometry))
    return trianglemesh(moved(make_cube(), own), alpha);
  // Texture coordinates of pbrt's disk run in other directions.
  if (std::holds_alternative<DiskShape>(s.geometry) && looks_at_uv(s))
    return trianglemesh(moved(disk_with_uvs(), own), alpha);
  if (std::optional<Statement> shape = quadric(s, own)) {
    if (alpha != FloatInput(1.0)) put(*shape, "alpha", alpha);
    world_text_ += shape->text();
  }
}

void SceneWriter::shape(const ShapeDescription& s, bool in_group) {
  if (const auto* instance = std::get_if<InstanceShape>(&s.geometry)) {
    if (!s.motion.empty() && !(s.to_world == Matrix4{})) lose(std::string(kStraight));
    world_text_ += "AttributeBegin\n";
    place(world_text_, s.to_world, s.motion);
    world_text_ += fmt::format("ObjectInstance {}\nAttributeEnd\n",
                               Statement::quoted(group_names_[instance->group]));
    return;
  }
  if (std::holds_alternative<SdfGridShape>(s.geometry) ||
      std::holds_alternative<HeightFieldShape>(s.geometry) ||
      std::holds_alternative<ForeignShape>(s.geometry))
    return lose(
        fmt::format("a shape is missing: pbrt-v4 has no \"{}\"",
                    std::visit([](const auto& g) { return std::string(g.name()); }, s.geometry)));
  const Surface surface = this->surface(s);
  // Texture coordinates of pbrt's sphere run from the bottom up.
  const bool is_sphere = std::holds_alternative<SphereShape>(s.geometry);
  Matrix4 to_world = s.to_world * (is_sphere ? Matrix4::scale(1, 1, -1) : Matrix4{}), own;
  if (!s.motion.empty()) {
    // What moves in pbrt is all of the transform, which goes straight from pose to pose: the rest
    // is the shape's own.
    const bool is_mesh = has_own_normals(s) || std::holds_alternative<MeshShape>(s.geometry);
    if (is_mesh || quadric(s, to_world))
      std::swap(own, to_world);
    else if (!(to_world == Matrix4{}))
      lose(std::string(kStraight));
  }
  world_text_ += "AttributeBegin\n" + media(s.interior, s.exterior);
  world_text_ += fmt::format("NamedMaterial {}\n", Statement::quoted(surface.material));
  if (s.emission && in_group)
    lose("what emits light in a group does not in pbrt");
  else if (s.emission)
    emission(*s.emission, surface.alpha);
  const Matrix4 start = s.motion.empty() ? to_world : s.motion.keyframes().front().pose * to_world;
  const bool has_normals =
      has_own_normals(s) || (std::holds_alternative<DiskShape>(s.geometry) && looks_at_uv(s));
  if (is_reversed(s, start, has_normals)) world_text_ += "ReverseOrientation\n";
  if (const auto* curve = std::get_if<CurvesShape>(&s.geometry)) {
    curves(s, *curve->curves, surface.alpha);
  } else {
    place(world_text_, to_world, s.motion);
    geometry(s, surface.alpha, own);
  }
  world_text_ += "AttributeEnd\n";
}

}  // namespace duet::pbrt
