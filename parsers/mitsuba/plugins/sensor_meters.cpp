// Sensors that measure.
#include "mitsuba/plugins/plugin.h"
#include "mitsuba/plugins/tables.h"

namespace duet::plugins {

namespace {

/// The transform whose +z is `direction`, from `origin`.
Matrix4 look_along(Properties& p, const Triple& origin, const Triple& direction) {
  if (const auto m = Matrix4::look_along(origin, direction)) return *m;
  p.error("direction", "the direction of a sensor cannot be zero");
  return {};
}

void read_target(SceneReader& s, Properties& p, SensorDescription& out) {
  if (p.has("target")) out.target_point = p.triple("target");
  const auto shapes = p.children(PluginKind::shape);
  if (shapes.empty()) return;
  if (shapes.size() > 1 || out.target_point || shapes[0].property->name != "target")
    return s.report().error(shapes[0].property->where, "{} has one \"target\": a point or a shape",
                            describe(p.node()));
  const Node& node = *shapes[0].node;
  s.shape(node, out.target_shape, false);
  if (out.target_shape.size() == 1 &&
      !std::holds_alternative<InstanceShape>(out.target_shape[0].geometry) &&
      !out.target_shape[0].emission)
    return;
  if (node.plugin && !s.report().has_errors())
    s.report().error(node.where, "a target neither shines nor holds other shapes");
  out.target_shape.clear();
}

void read_radiancemeter(SceneReader& s, Properties& p, SensorDescription& out) {
  out.kind = SensorKind::radiancemeter;
  read_sensor(s, p, out);
  p.only_one("origin", "to_world");
  p.only_one("direction", "to_world");
  if (p.has("origin") != p.has("direction"))
    p.error(p.has("origin") ? "origin" : "direction",
            "\"origin\" and \"direction\" are given together or not at all");
  const Triple origin = p.triple("origin"), direction = p.triple("direction");
  if (p.has("origin") && p.has("direction")) out.to_world = look_along(p, origin, direction);
}

void read_irradiancemeter(SceneReader& s, Properties& p, SensorDescription& out) {
  out.kind = SensorKind::irradiancemeter;
  read_sensor(s, p, out);
  if (p.has("to_world"))
    p.error("to_world", "{} stands where its shape is: it has no transform", describe(p.node()));
}

void read_distant(SceneReader& s, Properties& p, SensorDescription& out) {
  out.kind = SensorKind::distant;
  read_sensor(s, p, out);
  p.only_one("direction", "to_world");
  const Triple direction = p.triple("direction");
  if (p.has("direction")) out.to_world = look_along(p, {0, 0, 0}, direction);
  read_target(s, p, out);
}

void read_batch(SceneReader& s, Properties& p, SensorDescription& out) {
  out.kind = SensorKind::batch;
  read_sensor(s, p, out);
  for (const Properties::Child& child : p.children(PluginKind::sensor)) {
    SensorDescription part;
    if (!s.read_into(*child.node, part)) continue;
    if (part.kind == SensorKind::irradiancemeter || part.kind == SensorKind::batch) {
      s.report().error(part.where, "{} cannot stand in {}", describe(*child.node),
                       describe(p.node()));
      continue;
    }
    // The batch's own count.
    part.film = {};
    part.sampler = {};
    out.parts.push_back(std::move(part));
  }
  if (out.parts.empty() && !s.report().has_errors()) p.needs("a sensor");
}

}  // namespace

std::vector<Plugin> meters(const Parameter& response) {
  return {
      {"radiancemeter",
       both,
       {Parameter{"origin", point, "", "with direction, instead of to_world", any, v3},
        Parameter{"direction", point, "", "of the ray", any, v3}, response},
       &read_radiancemeter,
       "one pixel"},
      {"irradiancemeter", both, response, &read_irradiancemeter, "stands in a shape"},
      {"distant",
       v3,
       {Parameter{"direction", point, "", "of the rays; either this or to_world, whose +z it is"},
        parameter<SensorDescription>("target"), response},
       &read_distant,
       "one pixel"},
      {"batch", v3, response, &read_batch, "holds sensors, side by side on its film"},
  };
}

}  // namespace duet::plugins
