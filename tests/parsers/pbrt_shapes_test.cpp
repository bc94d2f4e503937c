// The geometry of pbrt's shapes.
#include "pbrt/shapes.h"

#include <doctest/doctest.h>

#include <cmath>

#include "pbrt/curves.h"
#include "pbrt/nurbs.h"
#include "pbrt/pbrt.h"
#include "scene/features.h"
#include "support/files.h"

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
  CHECK(mesh_area(pbrt::make_cone(3, 4, 90)) == doctest::Approx(kPiD * 3 * 5 / 4).epsilon(1e-3));
  // z = r² from 0 to 1.
  CHECK(mesh_area(pbrt::make_paraboloid(1, 0, 1, 360)) ==
        doctest::Approx(kPiD / 6 * (5 * std::sqrt(5.0) - 1)).epsilon(1e-3));
  CHECK(mesh_area(pbrt::make_hyperboloid({3, 0, 0}, {0, 0, 4}, 360)) ==
        doctest::Approx(kPiD * 3 * 5).epsilon(1e-3));
}

TEST_CASE("pbrt's cone, paraboloid and hyperboloid lie on their surfaces, normals across them") {
  const auto check = [](const TriangleMesh& mesh, const auto& value, const auto& gradient) {
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
      const Point3f& p = mesh.positions[i];
      CHECK(value(p) == doctest::Approx(0).epsilon(1e-4).scale(1));
      const Vector3f g = gradient(p);
      if (length_squared(g) > 1e-6f)
        CHECK(double(dot(normalize(g), Vector3f(mesh.normals[i]))) ==
              doctest::Approx(1).epsilon(1e-4));
      CHECK(double(length(Vector3f(mesh.normals[i]))) == doctest::Approx(1).epsilon(1e-4));
    }
    // The faces turn to the same side as the normals.
    for (const auto& [a, b, c] : mesh.triangles) {
      const Point3f p = mesh.positions[a];
      const Vector3f face = cross(mesh.positions[b] - p, mesh.positions[c] - p);
      CHECK(dot(face, Vector3f(mesh.normals[b]) + Vector3f(mesh.normals[c])) > 0);
    }
  };
  const auto r2 = [](const Point3f& p) {
    return double(p.x) * double(p.x) + double(p.y) * double(p.y);
  };
  check(
      pbrt::make_cone(2, 3, 200),
      [&](const Point3f& p) { return std::sqrt(r2(p)) - 2 * (1 - double(p.z) / 3); },
      [&](const Point3f& p) {
        const float r = float(std::sqrt(r2(p)));
        return r > 0 ? Vector3f(p.x / r, p.y / r, 2.0f / 3) : Vector3f(0);
      });
  const TriangleMesh bowl = pbrt::make_paraboloid(2, 0.5, 3, 360);
  check(
      bowl, [&](const Point3f& p) { return double(p.z) / 3 - r2(p) / 4; },
      [&](const Point3f& p) { return Vector3f(p.x / 2, p.y / 2, -1.0f / 3); });
  for (size_t i = 0; i < bowl.uvs.size(); ++i)
    CHECK(double(bowl.uvs[i].y) ==
          doctest::Approx((double(bowl.positions[i].z) - 0.5) / 2.5).epsilon(1e-4));
  // x² + y² = 1 + z² has such lines; one end of the other line lies on the axis.
  check(
      pbrt::make_hyperboloid({1, 0, 0}, {1, 1, 1}, 360),
      [&](const Point3f& p) { return r2(p) - 1 - double(p.z) * double(p.z); },
      [&](const Point3f& p) { return Vector3f(p.x, p.y, -p.z); });
  for (const Normal3f& n : pbrt::make_hyperboloid({0, 0, 0}, {1, 1, 1}, 360).normals)
    CHECK(double(length(Vector3f(n))) == doctest::Approx(1).epsilon(1e-4));
}

TEST_CASE("nurbs: a rational quadratic arc is a circle, with the parameters as coordinates") {
  // A quarter of a cylinder of radius 2 along z.
  pbrt::NurbsSurface s;
  s.u = {3, 3, {0, 0, 0, 1, 1, 1}, 0, 1};
  s.v = {2, 2, {5, 5, 7, 7}, 5, 6};
  const double w = std::sqrt(0.5);
  for (const double z : {0.0, 4.0})
    for (const auto& p :
         {std::array<double, 4>{2, 0, z, 1}, std::array<double, 4>{2 * w, 2 * w, z * w, w},
          std::array<double, 4>{0, 2, z, 1}})
      s.points.push_back(p);
  REQUIRE(pbrt::check_nurbs(s).empty());
  const TriangleMesh mesh = pbrt::make_nurbs(s);
  CHECK(mesh.positions.size() == 900);
  CHECK(mesh_area(mesh) == doctest::Approx(3.14159265 * 2).epsilon(1e-3));
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    const Point3f& p = mesh.positions[i];
    CHECK(double(p.x * p.x + p.y * p.y) == doctest::Approx(4).epsilon(1e-4));
    CHECK(double(p.z) == doctest::Approx(2 * (double(mesh.uvs[i].y) - 5)).epsilon(1e-4));
    CHECK(double(dot(Vector3f(mesh.normals[i]), Vector3f(p.x, p.y, 0))) ==
          doctest::Approx(2).epsilon(1e-4));
  }
  s.points[1][3] = 0;
  CHECK(pbrt::check_nurbs(s).find("weights") != std::string::npos);
  s.v.end = 8;
  CHECK(pbrt::check_nurbs(s).find("within its knots") != std::string::npos);
  s.u.knots.pop_back();
  CHECK(pbrt::check_nurbs(s).find("has 6 knots, not 5") != std::string::npos);
}

TEST_CASE("nurbs: inner knots join pieces without a break") {
  // Cubic with a double knot inside; x goes with u because the points are Greville's abscissae.
  pbrt::NurbsSurface s;
  s.u = {6, 4, {0, 0, 0, 0, 1, 1, 2, 2, 2, 2}, 0, 2};
  s.v = {2, 2, {0, 0, 1, 1}, 0, 1};
  for (int j = 0; j < 2; ++j)
    for (size_t i = 0; i < 6; ++i)
      s.points.push_back(
          {(s.u.knots[i + 1] + s.u.knots[i + 2] + s.u.knots[i + 3]) / 3, double(j), 0, 1});
  REQUIRE(pbrt::check_nurbs(s).empty());
  const TriangleMesh mesh = pbrt::make_nurbs(s);
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    CHECK(double(mesh.positions[i].x) ==
          doctest::Approx(double(mesh.uvs[i].x)).epsilon(1e-4).scale(1));
    CHECK(double(mesh.normals[i].z) == doctest::Approx(1).epsilon(1e-4));
  }
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
  // Those that come to a point, too.
  curve.width1 = 0;
  const CurveSet pointed = pbrt::make_tubes(curve);
  for (const float u : {0.0f, 0.5f, 1.0f})
    CHECK(curve_center(pointed, 0, u).radius ==
          doctest::Approx(0.2f * (1 - u)).epsilon(1e-5).scale(1));
  curve.points.pop_back();
  CHECK(!pbrt::check_curve(curve).empty());
}

TEST_CASE("pbrt curves are ribbons, but tubes where they are hair") {
  const test::TemporaryDirectory folder;
  const std::string curve =
      "Shape \"curve\" \"point3 P\" [0 0 0 1 0 0 2 0 0 3 0 0] \"string type\" ";
  Diagnostics diagnostics;
  const auto read = pbrt::read_pbrt(
      folder.write("scene.pbrt", "Film \"rgb\"\nWorldBegin\nNamedMaterial \"later\"\n" + curve +
                                     "\"flat\"\nMaterial \"diffuse\"\n" + curve + "\"flat\"\n" +
                                     curve + "\"cylinder\"\n" +
                                     "MakeNamedMaterial \"later\" \"string type\" \"hair\"\n"),
      {}, diagnostics);
  REQUIRE(read.has_value());
  const SceneDescription& d = read->description;
  const auto profile = [&](size_t i) {
    return std::get<CurvesShape>(d.shapes.at(i).geometry).curves->profile;
  };
  CHECK(profile(0) == CurveProfile::tube);
  CHECK(profile(1) == CurveProfile::ribbon);
  CHECK(profile(2) == CurveProfile::round_ribbon);
  // Light cannot be followed to what faces each ray, nor into what is seen from outside only.
  CHECK(scene_features(d).one_way_surfaces == 3);
}
