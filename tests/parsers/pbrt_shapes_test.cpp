// The geometry of pbrt's shapes.
#include "pbrt/shapes.h"

#include <doctest/doctest.h>

#include <cmath>

#include "pbrt/curves.h"

using namespace duet;

namespace {

double mesh_area(const TriangleMesh& mesh) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    area += 0.5 * double(length(cross(mesh.positions[b] - mesh.positions[a],
                                      mesh.positions[c] - mesh.positions[a])));
  return area;
}

}  // namespace

TEST_CASE("pbrt surfaces have the areas that their formulas say") {
  constexpr double kPiD = 3.14159265358979;
  CHECK(mesh_area(pbrt::make_sphere(2, -1, 1.5, 180)) ==
        doctest::Approx(kPiD * 2 * 2.5).epsilon(1e-3));
  CHECK(mesh_area(pbrt::make_cylinder(2, -1, 3, 90)) ==
        doctest::Approx(kPiD * 2 * 4 / 2).epsilon(1e-3));
  CHECK(mesh_area(pbrt::make_disk(2, 1, 0, 120)) == doctest::Approx(kPiD).epsilon(1e-3));
}

TEST_CASE("pbrt spheres begin their texture coordinates at the lower pole, and face outwards") {
  const TriangleMesh mesh = pbrt::make_sphere(2, -2, 2, 360);
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    const Point3f& p = mesh.positions[i];
    CHECK(double(p.z) ==
          doctest::Approx(-2 * std::cos(3.14159265 * double(mesh.uvs[i].y))).epsilon(1e-4));
    CHECK(double(dot(Vector3f(mesh.normals[i]), p - Point3f(0))) ==
          doctest::Approx(2).epsilon(1e-4));
  }
}

TEST_CASE("pbrt patches: parallelograms are two triangles, others follow the bilinear form") {
  pbrt::PatchMesh patches;
  patches.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  patches.patches = {{0, 1, 2, 3}};
  TriangleMesh flat;
  pbrt::append_patches(patches, flat);
  CHECK(flat.triangles.size() == 2);
  CHECK(double(flat.normals[0].z) == 1);
  patches.positions[3].z = 1;
  TriangleMesh bent;
  pbrt::append_patches(patches, bent);
  CHECK(bent.triangles.size() > 100);
  for (size_t i = 0; i < bent.positions.size(); ++i)
    CHECK(double(bent.positions[i].z) ==
          doctest::Approx(double(bent.uvs[i].x) * double(bent.uvs[i].y)).epsilon(1e-5));
}

TEST_CASE("Loop's subdivision leaves planes flat, and rounds an octahedron") {
  const TriangleMesh plane =
      pbrt::subdivide_loop({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 0}},
                           {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}, 2);
  CHECK(plane.triangles.size() == 4 * 16);
  for (const Point3f& p : plane.positions) CHECK(p.z == 0);
  for (const Normal3f& n : plane.normals) CHECK(std::abs(double(n.z)) == doctest::Approx(1));
  const std::vector<Point3f> corners{{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                     {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
  const TriangleMesh ball = pbrt::subdivide_loop(
      corners,
      {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}, 4);
  CHECK(ball.triangles.size() == 8 * 256);
  for (size_t i = 0; i < ball.positions.size(); ++i) {
    const Vector3f p = ball.positions[i] - Point3f(0);
    // Close to a sphere, whose normals look inwards as pbrt has them.
    CHECK(double(length(p)) == doctest::Approx(0.6).epsilon(0.15));
    CHECK(double(dot(Vector3f(ball.normals[i]), p)) < -0.9 * double(length(p)));
  }
}

TEST_CASE("pbrt curves: tubes go where Bezier curves do, as wide as they are") {
  pbrt::CurvePoints curve;
  curve.points = {{0, 0, 0}, {1, 2, 0}, {3, 2, 1}, {4, 0, 1}};
  curve.width0 = 0.4, curve.width1 = 0.2;
  CHECK(pbrt::check_curve(curve).empty());
  const CurveSet tubes = pbrt::make_tubes(curve);
  REQUIRE(tubes.segments.size() == 1);
  for (const double u : {0.0, 0.3, 0.5, 1.0}) {
    const CurveCenter c = curve_center(tubes, 0, float(u));
    const double v = 1 - u;
    for (int i = 0; i < 3; ++i) {
      const auto& p = curve.points;
      const size_t k = size_t(i);
      const double bezier = v * v * v * p[0][k] + 3 * v * v * u * p[1][k] +
                            3 * v * u * u * p[2][k] + u * u * u * p[3][k];
      CHECK(double(c.position[i]) == doctest::Approx(bezier).epsilon(1e-5));
    }
    CHECK(double(c.radius) == doctest::Approx(0.5 * (0.4 * v + 0.2 * u)).epsilon(1e-5));
  }
  curve.points.pop_back();
  CHECK(!pbrt::check_curve(curve).empty());
}
