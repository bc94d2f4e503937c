// Meshes made finer until their edges are short.
#include "geometry/edge_splitting.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>

using namespace duet;

namespace {

/// How often each edge is named, whichever way round.
std::map<std::pair<uint32_t, uint32_t>, int> edges(const TriangleMesh& mesh) {
  std::map<std::pair<uint32_t, uint32_t>, int> count;
  for (const auto& t : mesh.triangles)
    for (size_t i = 0; i < 3; ++i) ++count[std::minmax(t[i], t[(i + 1) % 3])];
  return count;
}

/// A tetrahedron with edges of different lengths.
TriangleMesh tetrahedron() {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {3, 0, 0}, {0, 1, 0}, {0.3f, 0.2f, 1.7f}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  mesh.uvs = {{0, 0}, {3, 0}, {0, 1}, {0.3f, 0.2f}};
  mesh.normals = {{-0.6f, 0, 0.8f}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  return mesh;
}

double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Point3f& p = mesh.positions[a];
    sum += 0.5 * double(length(cross(mesh.positions[b] - p, mesh.positions[c] - p)));
  }
  return sum;
}

}  // namespace

TEST_CASE("edges are split until they are short, and nothing gapes") {
  const Matrix4 stretch = Matrix4::scale(1, 4, 1);
  for (const double length : {10.0, 1.0, 0.3, 0.05}) {
    TriangleMesh mesh = tetrahedron();
    REQUIRE(split_long_edges(mesh, stretch, length, 1000000));
    CHECK(area(mesh) == doctest::Approx(area(tetrahedron())).epsilon(1e-4));
    const Transform place(stretch);
    double longest = 0;
    for (const auto& [edge, count] : edges(mesh)) {
      REQUIRE(count == 2);
      const auto [a, b] = edge;
      longest = std::max(longest,
                         double(duet::length(place(mesh.positions[a]) - place(mesh.positions[b]))));
    }
    CHECK(longest < length);
    // No finer than that needs: half of the longest edges were too long.
    CHECK(longest >= (length > 4 ? 0.0 : 0.4 * length));
    REQUIRE(mesh.uvs.size() == mesh.positions.size());
    REQUIRE(mesh.normals.size() == mesh.positions.size());
    for (size_t i = 0; i < mesh.uvs.size(); ++i) {
      CHECK(double(mesh.uvs[i].x) == doctest::Approx(double(mesh.positions[i].x)).epsilon(1e-5));
      CHECK(double(length_squared(Vector3f(mesh.normals[i]))) == doctest::Approx(1).epsilon(1e-4));
    }
  }
}

TEST_CASE("edges: a mesh that is short enough stays, and one that would be endless ends") {
  TriangleMesh mesh = tetrahedron();
  REQUIRE(split_long_edges(mesh, {}, 5, 10));
  CHECK(mesh == tetrahedron());
  CHECK_FALSE(split_long_edges(mesh, {}, 0.1, 100));
  // No area, but edges to be split.
  TriangleMesh needle;
  needle.positions = {{0, 0, 0}, {2, 0, 0}, {1, 0, 0}};
  needle.triangles = {{0, 1, 2}};
  CHECK_FALSE(split_long_edges(needle, {}, 0.01, 100));
  // No memory would do.
  CHECK_FALSE(split_long_edges(mesh, {}, 1e-30, size_t(1) << 60));
  // Shorter than coordinates can tell apart.
  mesh = tetrahedron();
  CHECK_FALSE(split_long_edges(mesh, Matrix4::translate(1e6, 0, 0), 1e-6, 10000));
}
