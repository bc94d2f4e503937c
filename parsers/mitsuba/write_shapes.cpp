// Shapes as Mitsuba 3 writes them.
#include "mitsuba/scene_writer.h"

namespace duet {

void SceneWriter::mesh(const MeshShape& m) {
  out_.string("filename", m.source.file);
  if (m.source.file.empty()) lose("a mesh that does not come from a file is missing");
  if (m.source.is_part)
    lose("parts of an OBJ file cannot be named in Mitsuba 3: each is the whole file");
  if (m.source.face_normals) out_.boolean("face_normals", true);
  if (m.source.plugin != "serialized") out_.boolean("flip_tex_coords", m.source.flip_tex_coords);
  if (m.source.plugin == "serialized") out_.integer("shape_index", m.source.shape_index);
  if (m.source.max_smooth_angle)
    lose("\"max_smooth_angle\" does not exist in Mitsuba 3: normals are those of the file");
}

void SceneWriter::height_field(const HeightFieldShape& f) {
  lose("the shape \"heightfield\" does not exist in Mitsuba 3");
  out_.reference({}, texture_id(f.heights));
  out_.number("scale", f.scale);
  out_.integer("width", f.width);
  out_.integer("height", f.height);
  out_.boolean("shading_normals", f.shading_normals);
  filter(f.filter);
}

void SceneWriter::meters(const ShapeDescription& s) {
  for (const SensorDescription& meter : d_.sensors)
    if (meter.kind == SensorKind::irradiancemeter && &d_.shapes[meter.shape] == &s) sensor(meter);
}

void SceneWriter::shape(const ShapeDescription& s, const std::string& id, std::string_view name) {
  constexpr std::string_view types[] = {
      "",         "rectangle", "cube",    "sphere",      "disk",
      "cylinder", "instance",  "sdfgrid", "linearcurve", "heightfield"};
  static_assert(std::size(types) == std::variant_size_v<decltype(s.geometry)>);
  const MeshShape* m = std::get_if<MeshShape>(&s.geometry);
  const CurvesShape* tubes = std::get_if<CurvesShape>(&s.geometry);
  const bool splines = tubes && tubes->curves->kind == CurveKind::bspline;
  out_.open("shape",
            m         ? std::string_view(m->source.plugin)
            : splines ? "bsplinecurve"
                      : types[s.geometry.index()],
            name, id);
  if (m) mesh(*m);
  if (tubes) {
    out_.string("filename", tubes->file);
    if (!tubes->curves->outside_only)
      lose("the hair of Mitsuba 0.6 has to be written as a file of curves with their radius");
  }
  if (const auto* sdf = std::get_if<SdfGridShape>(&s.geometry)) {
    out_.string("filename", sdf->file);
    if (sdf->grid && !sdf->grid->smooth_normals) out_.string("normals", "analytic");
  }
  if (const auto* field = std::get_if<HeightFieldShape>(&s.geometry)) height_field(*field);
  out_.transform("to_world", s.to_world);
  if (const auto* instance = std::get_if<InstanceShape>(&s.geometry)) {
    out_.reference({}, group_ids_[instance->group]);
    out_.close();
    return;
  }
  if (s.flip_normals) out_.boolean("flip_normals", true);
  out_.reference({}, material_id(s.material));
  if (s.interior) out_.reference("interior", medium_id(*s.interior));
  if (s.exterior) out_.reference("exterior", medium_id(*s.exterior));
  if (s.emission) {
    out_.open("emitter", s.emission->name());
    fields(*s.emission);
    out_.close();
  }
  meters(s);
  out_.close();
}

}  // namespace duet
