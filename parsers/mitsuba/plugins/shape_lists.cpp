// Plugins that stand for many shapes.
#include <cmath>

#include "math/polar.h"
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

using Rotation = std::array<std::array<double, 3>, 3>;

Rotation rotation_of(const double (&q)[4]) {
  const auto [x, y, z, w] = std::array<double, 4>{q[0], q[1], q[2], q[3]};
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
           {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
           {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}}};
}

/// Where Mitsuba puts the unit sphere: stretches of `to_world` are evened out.
Matrix4 placed(const Ellipsoid& e, double scale, const Matrix4& to_world, const PolarParts& d) {
  const double mean_scale = (d.stretch[0][0] + d.stretch[1][1] + d.stretch[2][2]) / 3;
  const Rotation own = rotation_of(e.quaternion);
  Matrix4 m;
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) {
      double sum = 0;
      for (size_t k = 0; k < 3; ++k) sum += d.rotation[int(i)][k] * own[k][j];
      m[int(i)][j] = sum * e.radius[j] * scale * std::abs(mean_scale);
    }
    const auto& row = to_world[int(i)];
    m[int(i)][3] = row[0] * e.center[0] + row[1] * e.center[1] + row[2] * e.center[2] + row[3];
  }
  return m;
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
  try {
    const PolarParts d = polar_parts(to_world);
    for (const Ellipsoid& e : s.files().read_ellipsoids(file)) {
      ShapeDescription shape = prototype;
      shape.to_world = placed(e, scale, to_world, d);
      out.shapes.push_back(std::move(shape));
    }
  } catch (const ReadError& error) {
    s.report().error(p.where("filename"), "{}", error.what());
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
