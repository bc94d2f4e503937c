#include "geometry/mesh.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

using namespace duet;

namespace {

/// Eight shared vertices, twelve triangles, outward.
TriangleMesh shared_cube() {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.push_back({i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f});
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

double difference(const Normal3f& a, const Normal3f& b) {
  return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
}

Normal3f face_normal(const TriangleMesh& mesh, const std::array<uint32_t, 3>& t) {
  const Point3f* p = mesh.positions.data();
  return Normal3f(normalize(cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]])));
}

}  // namespace

TEST_CASE("vertex normals of a cube point to its corners, however its sides are split") {
  // Only weights by angle give this: one side has one triangle at a corner, another has two.
  for (const float scale : {1.0f, 1e-25f, 1e-12f, 1e12f, 1e25f}) {
    TriangleMesh mesh = shared_cube();
    for (Point3f& p : mesh.positions) p = {p.x * scale, p.y * scale, p.z * scale};
    compute_vertex_normals(mesh);
    REQUIRE(mesh.normals.size() == 8);
    CHECK(mesh.computed_normals);
    const TriangleMesh unit = shared_cube();
    for (size_t i = 0; i < 8; ++i)
      CHECK(difference(mesh.normals[i], normalize(Normal3f(unit.positions[i]))) < 1e-6);
  }
}

TEST_CASE("vertex normals are the angle-weighted sums of Thürmer and Wüthrich") {
  std::mt19937 generator(1);
  std::uniform_real_distribution<float> uniform(-1, 1);
  TriangleMesh mesh;
  for (int i = 0; i < 60; ++i) {
    const float x = uniform(generator), y = uniform(generator);
    mesh.positions.push_back({x, y, uniform(generator)});
  }
  for (uint32_t i = 0; i < 300; ++i) {
    const uint32_t a = generator() % 60, b = (a + 1 + generator() % 20) % 60,
                   c = (b + 1 + generator() % 20) % 60;
    mesh.triangles.push_back({a, b, c});
  }
  compute_vertex_normals(mesh);
  std::vector<std::array<double, 3>> sums(60);
  for (const auto& t : mesh.triangles)
    for (size_t i = 0; i < 3; ++i) {
      double e[2][3], n[3], l0 = 0, l1 = 0, d = 0, ln = 0;
      for (int k = 0; k < 3; ++k) {
        e[0][k] = double(mesh.positions[t[(i + 1) % 3]][k]) - mesh.positions[t[i]][k];
        e[1][k] = double(mesh.positions[t[(i + 2) % 3]][k]) - mesh.positions[t[i]][k];
        l0 += e[0][k] * e[0][k], l1 += e[1][k] * e[1][k], d += e[0][k] * e[1][k];
      }
      for (int k = 0; k < 3; ++k) {
        n[k] = e[0][(k + 1) % 3] * e[1][(k + 2) % 3] - e[0][(k + 2) % 3] * e[1][(k + 1) % 3];
        ln += n[k] * n[k];
      }
      const double angle = std::acos(d / std::sqrt(l0 * l1));
      for (size_t k = 0; k < 3; ++k) sums[t[i]][k] += n[k] / std::sqrt(ln) * angle;
    }
  for (size_t i = 0; i < 60; ++i) {
    const auto& s = sums[i];
    const double l = std::sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
    CHECK(difference(mesh.normals[i], {float(s[0] / l), float(s[1] / l), float(s[2] / l)}) < 2e-6);
  }
}

TEST_CASE("vertices without a proper face get a normal of zero") {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 5, 5}};
  mesh.triangles = {{0, 1, 2}, {0, 0, 1}};
  compute_vertex_normals(mesh);
  for (const Normal3f& n : mesh.normals) CHECK(n == Normal3f{});
}

TEST_CASE("the normal of a corner whose angle is hardly a number has length one") {
  TriangleMesh mesh;
  mesh.positions = {{6e-40f, -3e31f, 2.5e13f}, {1.2e-38f, 0, 0}, {0, -1.5e29f, 9e-44f}};
  mesh.triangles = {{0, 1, 2}};
  compute_vertex_normals(mesh);
  for (const Normal3f& n : mesh.normals) CHECK(difference(n, {-1, 0, 0}) < 1e-6);
}

TEST_CASE("creases: faces share a normal only below the angle") {
  const auto creased = [](double angle) {
    TriangleMesh mesh = shared_cube();
    compute_creased_normals(mesh, angle);
    return mesh;
  };
  const TriangleMesh sharp = creased(80);
  CHECK(sharp.positions.size() == 24);
  for (const auto& t : sharp.triangles)
    for (uint32_t v : t) CHECK(difference(sharp.normals[v], face_normal(sharp, t)) < 1e-6);
  TriangleMesh smooth = shared_cube();
  compute_vertex_normals(smooth);
  const TriangleMesh round = creased(100);
  CHECK(round.positions.size() == 8);
  for (size_t t = 0; t < 12; ++t)
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t a = round.triangles[t][i], b = smooth.triangles[t][i];
      CHECK(round.positions[a] == smooth.positions[b]);
      CHECK(difference(round.normals[a], smooth.normals[b]) < 1e-6);
    }
}

TEST_CASE("creases merge what a file keeps apart without need, but not texture seams") {
  // Two triangles of one plane with vertices of their own.
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-0.0f, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  mesh.normals.assign(6, {1, 0, 0});
  mesh.attributes = {{"vertex_heat", 1, false, {1, 2, 3, 1, 3, 4}},
                     {"face_color", 3, true, {1, 2, 3, 4, 5, 6}}};
  TriangleMesh merged = mesh;
  compute_creased_normals(merged, 10);
  CHECK(merged.positions.size() == 4);
  CHECK(merged.find_attribute("vertex_heat")->data == std::vector<float>{1, 2, 3, 4});
  CHECK(merged.find_attribute("face_color")->data == mesh.attributes[1].data);
  for (const Normal3f& n : merged.normals) CHECK(n == Normal3f{0, 0, 1});

  TriangleMesh seam = mesh;
  seam.uvs = {{0, 0}, {1, 0}, {1, 1}, {0.5f, 0}, {1, 1}, {0, 1}};
  compute_creased_normals(seam, 10);
  CHECK(seam.positions.size() == 5);
  CHECK(seam.uvs.size() == 5);

  TriangleMesh heat = mesh;
  heat.attributes[0].data[3] = 7;
  compute_creased_normals(heat, 10);
  CHECK(heat.positions.size() == 5);
}

TEST_CASE("equal vertices are merged in every array, and normals count") {
  TriangleMesh mesh;
  mesh.positions = {{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.normals.assign(7, {0, 0, 1});
  mesh.normals[5] = {0, 1, 0};
  mesh.triangles = {{1, 2, 3}, {4, 5, 6}};
  merge_equal_vertices(mesh);
  CHECK(mesh.positions.size() == 5);  // the first is not used
  CHECK(mesh.triangles[0] == std::array<uint32_t, 3>{0, 1, 2});
  CHECK(mesh.triangles[1] == std::array<uint32_t, 3>{0, 3, 4});
  CHECK(mesh.normals[3] == Normal3f{0, 1, 0});
}

TEST_CASE("vertices that differ in an attribute only are not merged, however many there are") {
  // Without the attribute in the hash this would take minutes.
  constexpr uint32_t kVertices = 300000;
  TriangleMesh mesh;
  mesh.positions.resize(kVertices);
  mesh.attributes = {{"vertex_a", 1, false, {}}};
  for (uint32_t v = 0; v < kVertices; ++v) mesh.attributes[0].data.push_back(float(v / 2));
  for (uint32_t v = 0; v < kVertices; v += 3) mesh.triangles.push_back({v, v + 1, v + 2});
  merge_equal_vertices(mesh);
  CHECK(mesh.positions.size() == kVertices / 2);
  CHECK(mesh.attributes[0].data.size() == kVertices / 2);
  CHECK(mesh.attributes[0].data.back() == float(kVertices / 2 - 1));
}

TEST_CASE("normals from the file are carried along by a transform, computed ones are made again") {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.normals.assign(3, {0, 0, 1});
  TriangleMesh computed = mesh;
  compute_vertex_normals(computed);
  // Mitsuba 3.9.1: after scale(−1, 1, 1), given normals stay on their side; computed ones follow
  // the order of the vertices, which now runs clockwise.
  transform_mesh(mesh, Matrix4::scale(-1, 1, 1));
  transform_mesh(computed, Matrix4::scale(-1, 1, 1));
  CHECK(mesh.positions[1] == Point3f{-1, 0, 0});
  CHECK(mesh.triangles[0] == std::array<uint32_t, 3>{0, 1, 2});
  CHECK(mesh.normals[0] == Normal3f{0, 0, 1});
  CHECK(computed.normals[0] == Normal3f{0, 0, -1});

  // Stretching changes angles, and so their weights.
  TriangleMesh cube = shared_cube();
  compute_vertex_normals(cube);
  TriangleMesh expected = shared_cube();
  for (Point3f& p : expected.positions) p = {p.x * 5, p.y, p.z};
  compute_vertex_normals(expected);
  transform_mesh(cube, Matrix4::scale(5, 1, 1));
  CHECK(cube == expected);
}

TEST_CASE("normals keep their length under transforms of any scale") {
  for (const double scale : {1e-25, 1e-6, 1e6, 1e25}) {
    TriangleMesh mesh = make_cube();
    const TriangleMesh before = mesh;
    Matrix4 m;
    for (int i = 0; i < 3; ++i) m[i][i] = scale;
    transform_mesh(mesh, m);
    for (size_t i = 0; i < mesh.normals.size(); ++i)
      CHECK(difference(mesh.normals[i], before.normals[i]) < 1e-6);
  }
}

TEST_CASE("the rectangle and the cube agree with their normals") {
  for (const TriangleMesh& mesh : {make_rectangle(), make_cube()})
    for (const auto& t : mesh.triangles)
      for (uint32_t v : t) CHECK(face_normal(mesh, t) == mesh.normals[v]);
}
