#include "support/tables.h"
#include "support/source_path.h"

#include <fstream>
#include <stdexcept>

namespace duet::test {

Json read_table(const std::string& name) {
  std::ifstream in(source_path("reference/tables/") + name + ".json");
  if (!in) throw std::runtime_error("missing table " + name);
  return Json::parse(in);
}

Matrix4 to_matrix(const Json& rows) {
  Matrix4 m;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) m[i][j] = rows[size_t(i)][size_t(j)];
  return m;
}

TriangleMesh to_mesh(const Json& m) {
  TriangleMesh mesh;
  for (const Json& p : m["positions"]) mesh.positions.push_back(triple<Point3f>(p, 0));
  for (const Json& n : m["normals"]) mesh.normals.push_back(normalize(triple<Normal3f>(n, 0)));
  for (const Json& c : m["uvs"]) mesh.uvs.push_back({c[0].get<float>(), c[1].get<float>()});
  for (const Json& t : m["triangles"])
    mesh.triangles.push_back({t[0].get<uint32_t>(), t[1].get<uint32_t>(), t[2].get<uint32_t>()});
  return mesh;
}

}  // namespace duet::test
