// The arrays of meshes: positions, what they have at each of them, and faces.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "geometry/mesh.h"
#include "pbrt/values.h"

namespace duet::pbrt {

inline std::vector<Point3f> points(Values& v, std::string_view name) {
  std::vector<Point3f> result;
  const Parameter* p = v.given(name);
  if (!p) return result;
  result.reserve(p->numbers.size() / 3);
  for (size_t i = 0; i + 2 < p->numbers.size(); i += 3)
    result.push_back({float(p->numbers[i]), float(p->numbers[i + 1]), float(p->numbers[i + 2])});
  return result;
}

inline std::vector<Normal3f> normals(Values& v) {
  std::vector<Normal3f> result;
  for (const Point3f& p : points(v, "N"))
    result.push_back(normalized_or_zero(Normal3f(p.x, p.y, p.z)));
  return result;
}

inline std::vector<Point2f> texture_coordinates(Values& v, std::string_view name) {
  std::vector<Point2f> result;
  const Parameter* p = v.given(name);
  if (!p) return result;
  result.reserve(p->numbers.size() / 2);
  for (size_t i = 0; i + 1 < p->numbers.size(); i += 2)
    result.push_back({float(p->numbers[i]), float(p->numbers[i + 1])});
  return result;
}

/// Groups of N indices below `count`; nothing, after an error, if they are not.
template <size_t N>
std::optional<std::vector<std::array<uint32_t, N>>> indices(Values& v, size_t count) {
  std::vector<std::array<uint32_t, N>> result;
  Report& report = v.reader().report();
  const Parameter* p = v.given("indices");
  if (!p) {
    if (count != N) {
      report.error(v.where(), "\"integer indices\" is needed: there are {} points", count);
      return std::nullopt;
    }
    std::array<uint32_t, N> all;
    for (size_t i = 0; i < N; ++i) all[i] = uint32_t(i);
    result.push_back(all);
    return result;
  }
  if (p->numbers.size() % N != 0)
    report.warning(
        p->where,
        "the number of indices, {}, is no multiple of {}: the last ones are left out, as "
        "in pbrt",
        p->numbers.size(), N);
  result.resize(p->numbers.size() / N);
  for (size_t i = 0; i < result.size() * N; ++i) {
    const double index = p->numbers[i];
    if (!(index >= 0 && index < double(count))) {
      report.error(p->where, "index {} names no point: there are {}", index, count);
      return std::nullopt;
    }
    result[i / N][i % N] = uint32_t(index);
  }
  return result;
}

/// Leaves `values` out if there are not as many of them as there are points.
template <class T>
void match(Values& v, std::vector<T>& values, std::string_view name, size_t count) {
  if (values.empty() || values.size() == count) return;
  v.reader().report().warning(v.where(name),
                              "there are {} \"{}\", but {} points: they are left out, as in pbrt",
                              values.size(), name, count);
  values.clear();
}

/// Positions, normals, texture coordinates and `faces` of N points each. False after an error.
template <class Mesh, size_t N>
bool read_arrays(Values& v, std::string_view uv, Mesh& mesh,
                 std::vector<std::array<uint32_t, N>>& faces) {
  mesh.positions = points(v, "P");
  if (mesh.positions.empty()) {
    v.reader().report().error(v.where(), "\"point3 P\" is needed");
    return false;
  }
  auto read = indices<N>(v, mesh.positions.size());
  if (!read) return false;
  faces = std::move(*read);
  mesh.normals = normals(v);
  mesh.uvs = texture_coordinates(v, uv);
  match(v, mesh.normals, "N", mesh.positions.size());
  // v3 takes the first ones of too many.
  if (v.reader().version() == Version::v3 && mesh.uvs.size() > mesh.positions.size())
    mesh.uvs.resize(mesh.positions.size());
  match(v, mesh.uvs, uv, mesh.positions.size());
  return true;
}

}  // namespace duet::pbrt
