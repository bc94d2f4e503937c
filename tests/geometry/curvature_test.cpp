// Curvature against what geometry says of spheres, tubes, ellipsoids and meshes of them.
#include "geometry/curvature.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace duet;

namespace {

Shape analytic(ShapeKind kind, const Matrix4& to_world, bool flip = false) {
  Shape s;
  s.kind = kind;
  s.flip_normals = flip;
  s.to_world = Transform(to_world);
  s.to_local = *to_world.inverse();
  return s;
}

Curvature at(const Shape& shape, const Point2f& uv) {
  Surface s;
  s.shape = &shape;
  s.uv = uv;
  return curvature_at(s);
}

void check(const Curvature& c, double mean, double gaussian, double tolerance = 1e-4) {
  CHECK(std::abs(c.mean - mean) <= tolerance * std::abs(mean) + 1e-6);
  CHECK(std::abs(c.gaussian - gaussian) <= tolerance * std::abs(gaussian) + 1e-6);
}

Matrix4 turned(const Matrix4& m) {
  return Matrix4::translate(3, -1, 2) * Matrix4::rotate(40, 1, 2, 3) * m;
}

const Point2f kPlaces[] = {{0.1f, 0.2f}, {0.37f, 0.5f}, {0.8f, 0.9f}, {0.6f, 0.01f}};

/// A ball of radius r in triangles, with the ball's normals.
Shape ball_of_triangles(float r, bool with_uvs, bool flip) {
  constexpr int kAround = 64, kDown = 32;
  TriangleMesh m;
  for (int j = 0; j <= kDown; ++j)
    for (int i = 0; i <= kAround; ++i) {
      const float phi = 2 * kPi * float(i) / kAround, theta = kPi * float(j) / kDown;
      const Normal3f n(std::cos(phi) * std::sin(theta), std::sin(phi) * std::sin(theta),
                       std::cos(theta));
      m.positions.push_back(Point3f(5, 0, 0) + Vector3f(n) * r);
      m.normals.push_back(n);
      if (with_uvs) m.uvs.push_back({float(i) / kAround, float(j) / kDown});
    }
  for (uint32_t j = 1; j + 1 < kDown; ++j)
    for (uint32_t i = 0; i < kAround; ++i) {
      const uint32_t a = j * (kAround + 1) + i, b = a + kAround + 1;
      m.triangles.push_back({a, b, a + 1});
      m.triangles.push_back({a + 1, b, b + 1});
    }
  Shape s;
  s.flip_normals = flip;
  s.mesh = std::make_shared<TriangleMesh>(std::move(m));
  return s;
}

}  // namespace

TEST_CASE("a sphere of radius r has the curvatures 1/r and 1/r², outside negative") {
  for (const double r : {1.0, 0.25, 7.0})
    for (const Point2f& uv : kPlaces) {
      const Matrix4 m = turned(Matrix4::scale(r, r, r)), mirror = turned(Matrix4::scale(r, -r, r));
      check(at(analytic(ShapeKind::sphere, m), uv), -1 / r, 1 / (r * r));
      check(at(analytic(ShapeKind::sphere, m, true), uv), 1 / r, 1 / (r * r));
      // Mirrored spheres are inside out, mirrored cylinders are not.
      check(at(analytic(ShapeKind::sphere, mirror), uv), 1 / r, 1 / (r * r));
      check(at(analytic(ShapeKind::cylinder, mirror), uv), -0.5 / r, 0);
    }
}

TEST_CASE("a cylinder bends in one direction only, a disk in none") {
  for (const Point2f& uv : kPlaces) {
    const Matrix4 m = turned(Matrix4::scale(0.5, 0.5, 3));
    check(at(analytic(ShapeKind::cylinder, m), uv), -1, 0);
    check(at(analytic(ShapeKind::cylinder, m, true), uv), 1, 0);
    check(at(analytic(ShapeKind::disk, m), uv), 0, 0);
  }
}

TEST_CASE("an ellipsoid's curvatures are those of its implicit form") {
  const double a = 2, b = 0.7, c = 1.3;
  const Shape shape = analytic(ShapeKind::sphere, turned(Matrix4::scale(a, b, c)));
  for (const Point2f& uv : kPlaces) {
    const double phi = 2 * 3.14159265358979 * double(uv.x), theta = 3.14159265358979 * double(uv.y);
    const double x = a * std::cos(phi) * std::sin(theta), y = b * std::sin(phi) * std::sin(theta),
                 z = c * std::cos(theta);
    // Source: Goldman, "Curvature Formulas for Implicit Curves and Surfaces", 2005.
    const double g = x * x / std::pow(a, 4) + y * y / std::pow(b, 4) + z * z / std::pow(c, 4);
    const double gaussian = 1 / std::pow(a * b * c * g, 2);
    const double mean = (a * a + b * b + c * c - x * x - y * y - z * z) /
                        (2 * std::pow(a * b * c, 2) * std::pow(g, 1.5));
    check(at(shape, uv), -mean, gaussian, 1e-3);
  }
}

TEST_CASE("a mesh has the curvature of the surface that its normals belong to") {
  const float r = 2;
  for (const bool with_uvs : {false, true})
    for (const bool flip : {false, true}) {
      const Shape shape = ball_of_triangles(r, with_uvs, flip);
      for (uint32_t i = 0; i < shape.mesh->triangles.size(); i += 17) {
        Surface s;
        s.shape = &shape;
        s.primitive = i;
        s.barycentric = {0.3f, 0.4f};
        check(curvature_at(s), (flip ? 1 : -1) / double(r), 1 / double(r * r), 0.01);
      }
    }
  // Without normals, triangles are flat.
  Shape flat = ball_of_triangles(r, false, false);
  TriangleMesh mesh = *flat.mesh;
  mesh.normals.clear();
  flat.mesh = std::make_shared<TriangleMesh>(mesh);
  Surface s;
  s.shape = &flat;
  s.primitive = 3;
  s.barycentric = {0.3f, 0.4f};
  check(curvature_at(s), 0, 0);
}

TEST_CASE("a mesh's curvature does not depend on how its triangles are numbered") {
  // Normals that no surface has.
  TriangleMesh m;
  m.positions = {{0, 0, 0}, {1, 0.2f, 0.1f}, {0.3f, 0.8f, -0.2f}};
  m.normals = {{0.1f, 0.2f, 0.9f}, {-0.3f, 0.1f, 0.8f}, {0.2f, -0.5f, 0.7f}};
  const float weight[] = {0.2f, 0.5f, 0.3f};
  // From how the interpolated normal turns along the edges from the first vertex.
  const Vector3f e[] = {m.positions[1] - m.positions[0], m.positions[2] - m.positions[0]};
  const auto normal = [&](float b1, float b2) {
    return Vector3f(
        normalize(m.normals[0] * (1 - b1 - b2) + m.normals[1] * b1 + m.normals[2] * b2));
  };
  constexpr float h = 0.01f;
  const Vector3f turn[] = {
      (normal(weight[1] + h, weight[2]) - normal(weight[1] - h, weight[2])) * (0.5f / h),
      (normal(weight[1], weight[2] + h) - normal(weight[1], weight[2] - h)) * (0.5f / h)};
  double form[2][2], lengths[2][2];
  for (size_t i = 0; i < 2; ++i)
    for (size_t j = 0; j < 2; ++j) {
      form[i][j] = -double(dot(turn[i], e[j]));
      lengths[i][j] = double(dot(e[i], e[j]));
    }
  const auto determinant = [](const double(&f)[2][2]) {
    return f[0][0] * f[1][1] - f[0][1] * f[1][0];
  };
  const double gaussian = determinant(form) / determinant(lengths);
  const double mean = (form[0][0] * lengths[1][1] - form[0][1] * lengths[1][0] -
                       form[1][0] * lengths[0][1] + form[1][1] * lengths[0][0]) /
                      (2 * determinant(lengths));
  CHECK(std::abs(mean) > 0.1);
  for (const std::array<uint32_t, 3>& t :
       {std::array<uint32_t, 3>{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}}) {
    m.triangles = {t};
    Shape shape;
    shape.mesh = std::make_shared<TriangleMesh>(m);
    Surface s;
    s.shape = &shape;
    s.primitive = 0;
    s.barycentric = {weight[t[1]], weight[t[2]]};
    // The other way around, the normals are as they were.
    check(curvature_at(s), mean, gaussian, 1e-3);
  }
}
