// Shapes as Mitsuba 3 writes them.
#include "mitsuba/scene_writer.h"
#include "mitsuba/unstretched.h"

namespace duet {

void SceneWriter::mesh(const MeshShape& m) {
  out_.string("filename", m.source->file);
  if (m.source->file.empty()) lose("a mesh that does not come from a file is missing");
  if (m.displacement != FloatInput(0.0))
    lose("a mesh is not displaced, which Mitsuba 3 cannot say");
  if (m.source->is_part)
    lose("parts of an OBJ file cannot be named in Mitsuba 3: each is the whole file");
  if (m.source->face_normals) out_.boolean("face_normals", true);
  if (m.source->plugin != "serialized") out_.boolean("flip_tex_coords", m.source->flip_tex_coords);
  if (m.source->plugin == "serialized") out_.integer("shape_index", m.source->shape_index);
  if (m.source->max_smooth_angle)
    lose("\"max_smooth_angle\" does not exist in Mitsuba 3: normals are those of the file");
}

void SceneWriter::meters(const ShapeDescription& s) {
  for (const SensorDescription& meter : d_.sensors)
    if (meter.kind == SensorKind::irradiancemeter && &d_.shapes[meter.shape] == &s) sensor(meter);
}

void SceneWriter::shape(const ShapeDescription& s, const std::string& id, std::string_view name) {
  const auto geometry = [&]<class T>(const T& g) {
    out_.open("shape", g.name(), name, id);
    if constexpr (std::is_same_v<T, MeshShape>)
      mesh(g);
    else
      plugin("shape", g);
    if constexpr (std::is_same_v<T, SdfGridShape>)
      if (g.grid && !g.grid->smooth_normals) out_.string("normals", "analytic");
  };
  std::visit(geometry, s.geometry);
  const bool is_sphere = std::holds_alternative<SphereShape>(s.geometry);
  const auto round = is_sphere ? unstretched(s.to_world) : std::nullopt;
  if (round) lose("spheres stay round in Mitsuba 3: an ellipsoid becomes one");
  out_.transform("to_world", round.value_or(s.to_world));
  if (const auto* instance = std::get_if<InstanceShape>(&s.geometry)) {
    out_.reference({}, group_ids_[instance->group]);
    out_.close();
    return;
  }
  const auto is_bumpy = [](const MaterialModel& b) { return b.is<BumpMapMaterial>(); };
  const auto* m = std::get_if<MeshShape>(&s.geometry);
  if (m && m->mesh->bump_tangents != BumpTangents::derivatives && holds(d_, s.material, is_bumpy))
    lose("bumps on meshes with normals follow texture coordinates, not pbrt's tangents");
  if (s.flip_normals) out_.boolean("flip_normals", true);
  out_.reference({}, material_id(s.material));
  if (s.interior) out_.reference("interior", medium_id(*s.interior));
  if (s.exterior) out_.reference("exterior", medium_id(*s.exterior));
  if (s.emission) {
    out_.open("emitter", s.emission->name());
    plugin("emitter", *s.emission);
    out_.close();
  }
  meters(s);
  out_.close();
}

}  // namespace duet
