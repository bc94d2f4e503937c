// Plugins that stand for many shapes.
#include "mesh/ellipsoids.h"
#include "mitsuba/plugins/plugin.h"
#include "mitsuba/plugins/shapes.h"
#include "values/text.h"

namespace duet::plugins {

namespace {

void read_merge(SceneReader& s, Properties& p, ShapeList& out) {
  for (const Properties::Child& child : p.children(PluginKind::shape))
    s.shape(*child.node, out.shapes, false);
}

void read_ellipsoids_shape(SceneReader& s, Properties& p, ShapeList& out) {
  const std::string file = s.file(p, "filename");
  const Matrix4 to_world = p.transform("to_world");
  const double scale = p.number("scale_factor") * p.number("extent");
  ShapeDescription prototype;
  prototype.where = p.node().where;
  prototype.geometry = SphereShape{};
  s.attach_to_surface(p, prototype);
  if (prototype.emission)
    return s.report().error(prototype.emission->where, "{} cannot emit light", describe(p.node()));
  if (file.empty()) return;
  const auto all =
      s.report().from_file(p.where("filename"), [&] { return s.files().read_ellipsoids(file); });
  if (!all) return;
  for (const Matrix4& place : ellipsoid_places(*all, scale, to_world)) {
    prototype.to_world = place;
    out.shapes.push_back(prototype);
  }
}

ParameterList ellipsoid_parameters(const ParameterList& shell) {
  constexpr const char* python = "only exists in Python";
  const auto in_python = [](std::string_view name) {
    return Parameter{name, string, "", python, any, both, refused};
  };
  return {Parameter{.name = "filename", .type = file, .note = "a PLY file", .required = true},
          Parameter{"scale_factor", number, "1", "multiplies the radii", positive},
          Parameter{"extent", number, "3", "multiplies the radii too", positive},
          Parameter{"extent_adaptive_clamping", boolean, "", "these are surfaces here", any, both,
                    refused},
          shell,
          in_python("data"),
          in_python("centers"),
          in_python("scales"),
          in_python("quaternions")};
}

}  // namespace

Plugin merge() {
  return {.name = "merge",
          .versions = v3,
          .reader = &read_merge,
          .note = "holds shapes, which stay as they are"};
}

Plugin ellipsoids() {
  return {"ellipsoids", v3, ellipsoid_parameters({}), &read_ellipsoids_shape,
          "from files, without attributes and texture coordinates; cannot emit light"};
}

Plugin ellipsoidsmesh() {
  constexpr Parameter shell{"shell", string, "",          "ellipsoids are exact, not meshes",
                            any,     both,   approximated};
  return {"ellipsoidsmesh", v3,          ellipsoid_parameters(shell), &read_ellipsoids_shape,
          "as ellipsoids",  approximated};
}

}  // namespace duet::plugins
