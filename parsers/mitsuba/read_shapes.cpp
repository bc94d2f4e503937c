// What all shapes have: materials, lights, media and sensors on them.
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

}  // namespace

void SceneReader::attach_without_material(Properties& p, ShapeDescription& out) {
  out.to_world = p.transform("to_world", out.motion) * out.to_world;
  if (p.knows("flip_normals")) out.flip_normals = p.boolean("flip_normals");
  if (const Node* light = p.child(PluginKind::emitter)) out.emission = emission(*light);
  attach_media(*this, p, out);
  p.children(PluginKind::sensor);  // read when the shape has its place in the scene
}

MaterialId SceneReader::default_material(Properties& p, const ShapeDescription& shape) {
  const bool lit = p.child(PluginKind::emitter) != nullptr;
  // Where only media meet, Mitsuba 0.x sees no surface; Mitsuba 3 does.
  const bool invisible = p.is_0x() && !lit && (shape.interior || shape.exterior);
  const std::optional<float> grey = lit ? 0.0f : 0.5f;
  return shared_material(invisible ? std::nullopt : grey, p.node().where);
}

void SceneReader::attach_to_surface(Properties& p, ShapeDescription& shape) {
  const auto material = attached_material(*this, p);
  attach_without_material(p, shape);
  shape.material = material ? *material : default_material(p, shape);
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

}  // namespace duet
