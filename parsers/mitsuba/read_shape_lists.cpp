// Plugins that stand for many shapes.
#include <cmath>

#include "math/polar.h"
#include "mesh/ellipsoids.h"
#include "mitsuba/readers.h"
#include "mitsuba/scene_reader.h"
#include "values/text.h"

namespace duet {

void read_merge(SceneReader& s, Properties& p, ShapeList& out) {
  for (const Properties::Child& child : p.children(PluginKind::shape))
    s.shape(*child.node, out.shapes, false);
}

namespace {

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

}  // namespace

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

}  // namespace duet
