#include "mesh/ellipsoids.h"

#include <array>
#include <cmath>

#include "math/polar.h"
#include "mesh/ply_header.h"
#include "mesh/ply_values.h"

namespace duet {

std::vector<Ellipsoid> parse_ellipsoids(ByteReader& in) {
  const PlyHeader header = read_ply_header(in);
  if (header.elements.empty()) in.fail("has no elements");
  const PlyElement& element = header.elements[0];
  constexpr std::array<const char*, 10> kNames{"x",       "y",     "z",     "scale_0", "scale_1",
                                               "scale_2", "rot_0", "rot_1", "rot_2",   "rot_3"};
  std::array<int, 10> place;
  for (size_t i = 0; i < kNames.size(); ++i) {
    place[i] = element.find(kNames[i]);
    if (place[i] < 0) in.fail("has no property \"{}\", which ellipsoids have", kNames[i]);
  }
  PlyValues values(in, header.format);
  std::vector<Ellipsoid> out;
  std::vector<double> row(element.properties.size());
  for (uint64_t n = 0; n < element.count; ++n) {
    for (size_t i = 0; i < row.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      if (property.is_list)
        values.skip(property);
      else
        row[i] = values.next(property.type, property.name.c_str());
    }
    const auto value = [&](size_t i) { return row[size_t(place[i])]; };
    Ellipsoid e;
    for (size_t i = 0; i < 3; ++i) {
      e.center[i] = value(i);
      // As small as Mitsuba lets them be.
      e.radius[i] = std::max(std::exp(value(3 + i)), 1e-6);
    }
    const double w = value(6), x = value(7), y = value(8), z = value(9);
    const double length = std::sqrt(w * w + x * x + y * y + z * z);
    const double parts[] = {x / length, y / length, z / length, w / length};
    std::copy(parts, parts + 4, e.quaternion);
    bool finite = length > 0;
    for (const double v :
         {e.center[0], e.center[1], e.center[2], e.radius[0], e.radius[1], e.radius[2], length})
      finite &= std::isfinite(float(v));
    if (!finite) in.fail("ellipsoid {} has no finite size, place or rotation", n);
    out.push_back(e);
  }
  in.end_text();
  if (out.empty()) in.fail("has no ellipsoids");
  return out;
}

std::vector<Ellipsoid> read_ellipsoids(const std::string& file) {
  return parse_file(file, parse_ellipsoids);
}

namespace {

using Rotation = std::array<std::array<double, 3>, 3>;

Rotation rotation_of(const double (&q)[4]) {
  const auto [x, y, z, w] = std::array<double, 4>{q[0], q[1], q[2], q[3]};
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
           {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
           {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}}};
}

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

std::vector<Matrix4> ellipsoid_places(const std::vector<Ellipsoid>& all, double scale,
                                      const Matrix4& to_world) {
  const PolarParts parts = polar_parts(to_world);
  std::vector<Matrix4> places;
  for (const Ellipsoid& e : all) places.push_back(placed(e, scale, to_world, parts));
  return places;
}

}  // namespace duet
