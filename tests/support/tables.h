// Reads the tables of reference/tables, in which Mitsuba has answered small questions.
#pragma once

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "geometry/mesh.h"
#include "math/transform.h"

namespace duet::test {

using Json = nlohmann::json;

inline Json read_table(const std::string& name) {
  std::ifstream in(std::string(DUET_SOURCE_DIR) + "/reference/tables/" + name + ".json");
  if (!in) throw std::runtime_error("missing table " + name);
  return Json::parse(in);
}

inline Matrix4 to_matrix(const Json& rows) {
  Matrix4 m;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) m[i][j] = rows[size_t(i)][size_t(j)];
  return m;
}

/// Three numbers of a row, from index `first`.
template <class T>
T triple(const Json& row, size_t first) {
  return {row[first].get<float>(), row[first + 1].get<float>(), row[first + 2].get<float>()};
}

/// The mesh of the tables, with all that it has.
inline TriangleMesh to_mesh(const Json& m) {
  TriangleMesh mesh;
  for (const Json& p : m["positions"]) mesh.positions.push_back(triple<Point3f>(p, 0));
  for (const Json& n : m["normals"]) mesh.normals.push_back(normalize(triple<Normal3f>(n, 0)));
  for (const Json& c : m["uvs"]) mesh.uvs.push_back({c[0].get<float>(), c[1].get<float>()});
  for (const Json& t : m["triangles"])
    mesh.triangles.push_back({t[0].get<uint32_t>(), t[1].get<uint32_t>(), t[2].get<uint32_t>()});
  return mesh;
}

}  // namespace duet::test
