#include "geometry/height_field.h"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <random>

using namespace duet;

namespace {

/// Heights of a function of the square from (−1, −1) to (1, 1).
HeightField sampled(int columns, int rows, const std::function<double(double, double)>& f,
                    bool shading_normals = true) {
  HeightField field{columns, rows, {}, shading_normals};
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x)
      field.heights.push_back(float(f(2.0 * x / (columns - 1) - 1, 2.0 * y / (rows - 1) - 1)));
  return field;
}

/// The height of the bilinear patch above a point.
double patch_height(const HeightField& f, double x, double y) {
  const double s = 0.5 * (x + 1) * (f.columns - 1), t = 0.5 * (y + 1) * (f.rows - 1);
  const int i = std::min(int(s), f.columns - 2), j = std::min(int(t), f.rows - 2);
  const auto h = [&](int a, int b) {
    return double(f.heights[size_t(b) * size_t(f.columns) + size_t(a)]);
  };
  const double u = s - i, v = t - j;
  return (1 - v) * ((1 - u) * h(i, j) + u * h(i + 1, j)) +
         v * ((1 - u) * h(i, j + 1) + u * h(i + 1, j + 1));
}

/// The greatest distance between the triangles and the patches, looked for on each triangle.
double deviation(const HeightField& f, const TriangleMesh& mesh) {
  double most = 0;
  for (const auto& t : mesh.triangles)
    for (int i = 0; i <= 4; ++i)
      for (int j = 0; i + j <= 4; ++j) {
        const Point3f &a = mesh.positions[t[0]], &b = mesh.positions[t[1]],
                      &c = mesh.positions[t[2]];
        const Point3f p = a + (b - a) * (float(i) / 4) + (c - a) * (float(j) / 4);
        most = std::max(most, std::abs(double(p.z) - patch_height(f, double(p.x), double(p.y))));
      }
  return most;
}

void check_normal(const Normal3f& n, double x, double y, double z) {
  const double l = std::sqrt(x * x + y * y + z * z);
  CHECK(double(n.x) == doctest::Approx(x / l).epsilon(1e-5));
  CHECK(double(n.y) == doctest::Approx(y / l).epsilon(1e-5));
  CHECK(double(n.z) == doctest::Approx(z / l).epsilon(1e-5));
}

double mesh_area(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const Point3f& a = mesh.positions[t[0]];
    const Vector3f n = cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a);
    CHECK(n.z > 0);
    sum += 0.5 * double(n.z);
  }
  return sum;
}

}  // namespace

TEST_CASE("height field: a plane is two triangles a patch, with its slope and its coordinates") {
  for (const bool smooth : {true, false}) {
    const HeightField f = sampled(
        5, 3, [](double x, double y) { return 0.25 * x - 0.5 * y + 3; }, smooth);
    const TriangleMesh mesh = make_height_field(f);
    CHECK(mesh.triangles.size() == 2 * 4 * 2);
    CHECK(mesh.positions.size() == (smooth ? 15 : 4 * 8));
    CHECK(mesh_area(mesh) == doctest::Approx(4));
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
      const Point3f& p = mesh.positions[i];
      CHECK(double(p.z) == doctest::Approx(0.25 * double(p.x) - 0.5 * double(p.y) + 3));
      CHECK(mesh.uvs[i].x == doctest::Approx(0.5 * (double(p.x) + 1)));
      CHECK(mesh.uvs[i].y == doctest::Approx(0.5 * (double(p.y) + 1)));
      check_normal(mesh.normals[i], -0.25, 0.5, 1);
    }
    // The first row lies along y = −1.
    CHECK(mesh.positions.front() == Point3f(-1, -1, 3.25f));
  }
}

TEST_CASE("height field: twisted patches are divided until they are close") {
  for (const bool smooth : {true, false}) {
    // The saddle z = x y on one patch: its twist is 4, its range 2.
    const HeightField f = sampled(
        2, 2, [](double x, double y) { return x * y; }, smooth);
    const TriangleMesh mesh = make_height_field(f);
    // 4 / (4 n²) ≤ 2 / 512 from n = 16 on.
    CHECK(mesh.triangles.size() == 2 * 16 * 16);
    CHECK(mesh.positions.size() == 17 * 17);
    CHECK(mesh_area(mesh) == doctest::Approx(4));
    const double d = deviation(f, mesh);
    CHECK(d <= 2.0 / 512 * (1 + 1e-6));
    CHECK(d > 0.9 * 2 / 512);
    for (const Point3f& p : mesh.positions)
      CHECK(double(p.z) == doctest::Approx(double(p.x) * double(p.y)));
  }
}

TEST_CASE("height field: a paraboloid between its corners is bilinear, its normals nearly exact") {
  const auto height = [](double x, double y) { return 0.5 * x * x + 0.25 * y * y + x * y; };
  const HeightField f = sampled(65, 33, height);
  const TriangleMesh mesh = make_height_field(f);
  CHECK(deviation(f, mesh) <= 1.75 / 512);
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    const double x = double(mesh.positions[i].x), y = double(mesh.positions[i].y);
    // Linear interpolation between corners errs by h²/8 times the curvature.
    CHECK(std::abs(double(mesh.positions[i].z) - height(x, y)) < 1.0 / 32 / 32);
    if (std::abs(x) > 0.96 || std::abs(y) > 0.93) continue;  // a corner has half its patches there
    const Vector3f n = normalize(Vector3f(float(-x - y), float(-0.5 * y - x), 1));
    CHECK(dot(Vector3f(mesh.normals[i]), n) > 0.9999f);
  }
}

TEST_CASE("height field: normals at corners are the mean of the patches' unit normals there") {
  // One peak in the middle; cells have sides of length one in the world, too.
  const HeightField f = sampled(3, 3, [](double x, double y) { return x == 0 && y == 0 ? 1 : 0; });
  const TriangleMesh mesh = make_height_field(f);
  // Twist 1 and range 1: 1 / (4 n²) ≤ 1 / 512 from n = 16 on.
  const size_t width = 33;
  REQUIRE(mesh.positions.size() == width * width);
  const auto normal = [&](int x, int y) {
    return mesh.normals[size_t(16 * y) * width + size_t(16 * x)];
  };
  check_normal(normal(1, 1), 0, 0, 1);
  check_normal(normal(0, 1), -1, 0, 1);
  check_normal(normal(1, 2), 0, 1, 1);
  check_normal(normal(0, 0), 0, 0, 1);
  // On the way between two corners they are mixed bilinearly, before they get their length.
  const float r = std::sqrt(0.5f);
  check_normal(mesh.normals[16 * width + 8], -0.5 * double(r), 0, 0.5 + 0.5 * double(r));
  // The same heights on twice the cells along x, which are half as long: twice as steep there.
  const TriangleMesh narrow =
      make_height_field(sampled(5, 3, [](double x, double y) { return x == 0 && y == 0 ? 1 : 0; }));
  const size_t n = 16;
  check_normal(narrow.normals[n * (4 * n + 1) + n], -2 * double(r), 0, 1 + double(r));
}

TEST_CASE("height field: without shading normals each patch keeps its own") {
  const HeightField f = sampled(
      3, 2, [](double x, double y) { return x == 0 && y > 0 ? 1.0 : 0.0; }, false);
  const TriangleMesh mesh = make_height_field(f);
  // Two patches of 17 × 17 vertices, equal but for their sides.
  REQUIRE(mesh.positions.size() == 2 * 17 * 17);
  for (int j = 0; j <= 16; ++j)
    for (int i = 0; i <= 16; ++i) {
      const double u = i / 16.0, v = j / 16.0;
      const size_t first = size_t(17 * j + i);
      CHECK(double(mesh.positions[first].z) == doctest::Approx(u * v));
      // Cells are one wide and two high.
      check_normal(mesh.normals[first], -v, -u / 2, 1);
      check_normal(mesh.normals[289 + first], v, -(1 - u) / 2, 1);
    }
}

TEST_CASE("height field: large ones are not divided any further") {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto noise = [&](double, double) { return uniform(generator); };
  const HeightField rough = sampled(513, 513, noise);
  CHECK(make_height_field(rough).triangles.size() == 2 * 512 * 512);
  const HeightField less = sampled(257, 129, noise);
  const TriangleMesh mesh = make_height_field(less);
  // 65536 triangles without division, 2²⁰ with 4 × 4.
  CHECK(mesh.triangles.size() == 1 << 20);
  CHECK(deviation(less, mesh) <= 2.0 / (4 * 4 * 4));
}
