// Shapes, with the materials and lights on them.
#include <algorithm>
#include <cmath>
#include <limits>

#include "mitsuba/mesh_options.h"
#include "mitsuba/property_values.h"
#include "mitsuba/readers.h"
#include "mitsuba/scene_reader.h"
#include "values/text.h"

namespace duet {

namespace {

/// The nested material; nothing if there is none or it has an error.
std::optional<MaterialId> attached_material(SceneReader& s, Properties& p) {
  const Node* node = nullptr;
  for (const Properties::Child& child : p.children(PluginKind::bsdf)) {
    // Mitsuba 0.x takes the last one.
    if (node && p.is_0x())
      s.report().warning(child.property->where, "{} has several BSDFs, and the last one holds",
                         describe(p.node()));
    else if (node)
      s.report().error(child.property->where, "{} can have only one bsdf", describe(p.node()));
    node = child.node;
  }
  return node ? s.material(*node) : std::nullopt;
}

void attach_media(SceneReader& s, Properties& p, ShapeDescription& out) {
  for (const Properties::Child& child : p.children(PluginKind::medium)) {
    const std::string& name = child.property->name;
    if (name != "interior" && name != "exterior" && !p.is_0x()) {
      // Mitsuba 3 loads it and goes on without a word.
      s.report().warning(child.property->where,
                         "the medium has no effect: it is called neither \"interior\" nor "
                         "\"exterior\"");
      s.medium(*child.node);
      continue;
    }
    if (name != "interior" && name != "exterior") {
      s.report().error(child.property->where,
                       "a medium of a shape is called \"interior\" or \"exterior\", not {}",
                       in_quotes(name));
      continue;
    }
    std::optional<MediumId>& side = name == "interior" ? out.interior : out.exterior;
    if (side)
      s.report().error(child.property->where, "the {} of {} is given twice", name,
                       describe(p.node()));
    side = s.medium(*child.node);
  }
}

void attach(SceneReader& s, Properties& p, ShapeDescription& out) {
  const auto material = attached_material(s, p);
  s.attach_without_material(p, out);
  out.material = material ? *material : s.default_material(p, out);
}

}  // namespace

MeshOptions mesh_options(Properties& p, MeshSource& source) {
  source.plugin = p.node().plugin->name;
  source.face_normals = p.boolean("face_normals");
  MeshOptions options;
  options.face_normals = source.face_normals;
  options.flip_tex_coords = source.plugin != "serialized" && p.boolean("flip_tex_coords");
  source.flip_tex_coords = options.flip_tex_coords;
  options.max_smooth_angle = source.max_smooth_angle = p.optional_number("max_smooth_angle");
  if (options.face_normals && options.max_smooth_angle)
    p.error("max_smooth_angle", "both \"face_normals\" and \"max_smooth_angle\" are given");
  return options;
}

void SceneReader::attach_without_material(Properties& p, ShapeDescription& out) {
  out.to_world = p.transform("to_world", out.motion) * out.to_world;
  if (find_parameter(PluginKind::shape, *p.node().plugin, "flip_normals"))
    out.flip_normals = p.boolean("flip_normals");
  if (const Node* light = p.child(PluginKind::emitter)) out.emission = emission(*light);
  attach_media(*this, p, out);
  p.children(PluginKind::sensor);  // read when the shape has its place in the scene
}

MaterialId SceneReader::default_material(Properties& p, const ShapeDescription& shape) {
  const bool lit = p.child(PluginKind::emitter) != nullptr;
  // Where only media meet, Mitsuba 0.x sees no surface; Mitsuba 3 does.
  const bool invisible = p.is_0x() && !lit && (shape.interior || shape.exterior);
  return invisible ? null_material(p.node().where)
                   : grey_material(lit ? 0.0f : 0.5f, p.node().where);
}

void SceneReader::attach_to_surface(Properties& p, ShapeDescription& shape) {
  attach(*this, p, shape);
}

void SceneReader::sensors_on_shape(const Node& node, bool misplaced, size_t shape) {
  for (const Property& property : node.properties) {
    const Node* const* child = std::get_if<const Node*>(&property.value);
    if (!child || (*child)->kind != PluginKind::sensor) continue;
    SensorDescription sensor;
    sensor.shape = uint32_t(shape);
    if (!read_into(**child, sensor)) continue;
    if (sensor.kind != SensorKind::irradiancemeter || misplaced)
      report_.error((*child)->where, "{} cannot stand in {}", describe(**child),
                    misplaced ? "a shape of this place" : "a shape");
    else
      description_.sensors.push_back(std::move(sensor));
  }
}

void SceneReader::shape(const Node& node, std::vector<ShapeDescription>& shapes, bool in_group) {
  if (!node.plugin) return;
  const bool is_group =
      std::holds_alternative<ReadInto<ShapeGroupDescription>>(node.plugin->reader);
  if (in_group && (is_group || node.plugin->name == "instance")) {
    report_.error(node.where, "{} cannot stand in a shape group", describe(node));
  } else if (is_group) {
    shape_group(node);
  } else if (std::holds_alternative<ReadInto<ShapeList>>(node.plugin->reader)) {
    ShapeList list;
    if (!read_into(node, list)) return;
    for (ShapeDescription& s : list.shapes) {
      if (in_group && s.emission)
        report_.error(s.emission->where, "a shape in a shape group cannot emit light");
      shapes.push_back(std::move(s));
    }
    sensors_on_shape(node, in_group || &shapes != &description_.shapes || list.shapes.size() != 1,
                     shapes.size() - 1);
  } else if (ShapeDescription shape;
             shape.where = node.where, shape.label = {node.id}, read_into(node, shape)) {
    if (in_group && shape.emission)
      report_.error(shape.emission->where, "a shape in a shape group cannot emit light");
    if (in_group && !shape.motion.empty())
      report_.error(node.where, "a shape in a shape group cannot move; its instances can");
    shapes.push_back(std::move(shape));
    sensors_on_shape(node, in_group || &shapes != &description_.shapes, shapes.size() - 1);
  }
}

void read_mesh(SceneReader& s, Properties& p, ShapeDescription& out) {
  MeshShape shape;
  shape.source.file = s.file(p, "filename");
  MeshOptions options = mesh_options(p, shape.source);
  if (shape.source.plugin == "serialized")
    options.shape_index = shape.source.shape_index = p.integer("shape_index");
  if (!shape.source.file.empty())
    shape.mesh = s.mesh(shape.source.plugin, shape.source.file, options, p.where("filename"));
  out.geometry = std::move(shape);
  attach(s, p, out);
}

void read_rectangle(SceneReader& s, Properties& p, ShapeDescription& out) {
  out.geometry = RectangleShape{};
  attach(s, p, out);
}

void read_cube(SceneReader& s, Properties& p, ShapeDescription& out) {
  out.geometry = CubeShape{};
  attach(s, p, out);
}

void read_disk(SceneReader& s, Properties& p, ShapeDescription& out) {
  out.geometry = DiskShape{};
  attach(s, p, out);
}

void read_sdfgrid(SceneReader& s, Properties& p, ShapeDescription& out) {
  enum class Normals { smooth, analytic };
  const auto normals =
      p.choice<Normals>("normals", {{"smooth", Normals::smooth}, {"analytic", Normals::analytic}});
  const std::string file = s.file(p, "filename");
  attach(s, p, out);
  if (out.emission)
    s.report().error(out.emission->where, "{} cannot emit light", describe(p.node()));
  if (file.empty()) return;
  const SourceLocation where = p.where("filename");
  bool is_float32;
  const auto volume = s.volume_grid(file, where, is_float32);
  if (!volume) return;
  if (volume->channels != 1)
    return s.report().error(where, "{} has {} channels: distances have one", in_quotes(file),
                            volume->channels);
  if (*std::min_element(volume->size.begin(), volume->size.end()) < 2)
    return s.report().error(where, "{} needs two nodes at least along each axis", in_quotes(file));
  if (volume->node_count() > size_t(std::numeric_limits<int>::max()))
    return s.report().error(where, "{} has too many nodes", in_quotes(file));
  auto grid = std::make_shared<SdfGrid>();
  grid->size = volume->size;
  grid->values = volume->values;
  grid->smooth_normals = normals == Normals::smooth;
  grid->cells = surface_cells(*grid);
  if (grid->cells.empty())
    return s.report().error(where, "{} is nowhere zero: it has no surface", in_quotes(file));
  out.geometry = SdfGridShape{std::move(grid), file};
}

void read_sphere(SceneReader& s, Properties& p, ShapeDescription& out) {
  out.geometry = SphereShape{};
  const Triple c = p.triple("center");
  double r = p.number("radius");
  // In Mitsuba 3 it scales, so that a negative one turns the normals.
  if (r == 0 || (r < 0 && p.is_0x())) {
    if (p.is_0x())
      p.error("radius", "the parameter \"radius\" of {} must be positive, not {}",
              describe(p.node()), r);
    else
      p.error("radius", "the parameter \"radius\" of {} must be other than 0", describe(p.node()));
    r = 1;
  }
  out.to_world = Matrix4::translate(c[0], c[1], c[2]) * Matrix4::scale(r, r, r);
  attach(s, p, out);
}

void read_cylinder(SceneReader& s, Properties& p, ShapeDescription& out) {
  out.geometry = CylinderShape{};
  const Triple p0 = p.triple("p0"), p1 = p.triple("p1");
  const double radius = p.number("radius");
  Triple d{p1[0] - p0[0], p1[1] - p0[1], p1[2] - p0[2]};
  const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  if (!(length > 0)) {
    p.error("p1", "the ends \"p0\" and \"p1\" of the cylinder are the same point");
    return;
  }
  for (double& v : d) v /= length;
  // The seam of the surface lies where Mitsuba puts it.
  const Triple u = orthogonal_vector(d, p.node().version);
  Matrix4 frame;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    frame[i] = {u[i] * radius, (d[j] * u[k] - d[k] * u[j]) * radius, d[i] * length, p0[i]};
  }
  out.to_world = frame;
  attach(s, p, out);
}

namespace {

/// What curves have, whose faces cannot be turned.
void attach_to_curves(SceneReader& s, Properties& p, ShapeDescription& out) {
  attach(s, p, out);
  if (out.emission)
    s.report().error(out.emission->where, "{} cannot emit light", describe(p.node()));
}

}  // namespace

void read_curves_shape(SceneReader& s, Properties& p, ShapeDescription& out) {
  const CurveKind kind =
      p.node().plugin->name == "bsplinecurve" ? CurveKind::bspline : CurveKind::linear;
  const std::string file = s.file(p, "filename");
  attach_to_curves(s, p, out);
  if (file.empty()) return;
  try {
    out.geometry = CurvesShape{std::make_shared<CurveSet>(s.files().read_curves(file, kind)), file};
  } catch (const ReadError& error) {
    s.report().error(p.where("filename"), "{}", error.what());
  }
}

void read_hair_shape(SceneReader& s, Properties& p, ShapeDescription& out) {
  const std::string file = s.file(p, "filename");
  const double reduction = p.number("reduction");
  // Which hairs are culled is random in Mitsuba 0.6; all of them look as they should.
  const double radius = p.number("radius");
  if (reduction > 0)
    s.approximate_loudly(p.where("reduction"), "no hair is left out: \"reduction\" is ignored");
  s.approximate(p.node().where, "the joints of hair are spheres, not mitres");
  attach_to_curves(s, p, out);
  if (file.empty()) return;
  try {
    out.geometry =
        CurvesShape{std::make_shared<CurveSet>(s.files().read_hair(file, float(radius))), file};
  } catch (const ReadError& error) {
    s.report().error(p.where("filename"), "{}", error.what());
  }
}

void read_instance(SceneReader& s, Properties& p, ShapeDescription& out) {
  out.to_world = p.transform("to_world", out.motion);
  const Node* node = p.child(PluginKind::shape);
  if (!node) {
    s.report().error(p.node().where, "{} needs a reference to a shape group", describe(p.node()));
    return;
  }
  if (!node->plugin) return;
  if (!std::holds_alternative<ReadInto<ShapeGroupDescription>>(node->plugin->reader)) {
    s.report().error(p.node().where, "{} needs a shape group, not {}", describe(p.node()),
                     describe(*node));
    return;
  }
  if (const auto group = s.shape_group(*node)) out.geometry = InstanceShape{*group};
}

void read_shapegroup(SceneReader& s, Properties& p, ShapeGroupDescription& out) {
  for (const Properties::Child& child : p.children(PluginKind::shape))
    s.shape(*child.node, out.shapes, true);
}

}  // namespace duet
