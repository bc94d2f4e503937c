// Curvature against what geometry says of spheres, tubes, ellipsoids and meshes of them.
#include "geometry/curvature.h"
#include "support/lamp.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace duet;
using namespace duet::test;

namespace {

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

namespace {

/// The surface at a place, found by a ray towards it; for meshes the triangle is given instead.
Surface seen(const Shape& shape, const Instance* instance, const Point2f& at) {
  const auto place = [&](const auto& x) { return instance ? instance->to_world(x) : x; };
  Hit hit{};
  if (shape.mesh) {
    hit.u = at.x, hit.v = at.y;
    return make_surface(shape, instance, {}, hit);
  }
  const float phi = 2 * kPi * at.x, theta = kPi * at.y;
  const Point3f unit = shape.kind == ShapeKind::sphere
                           ? Point3f(std::cos(phi) * std::sin(theta),
                                     std::sin(phi) * std::sin(theta), std::cos(theta))
                           : Point3f(std::cos(phi), std::sin(phi), at.y);
  const Point3f p = place(shape.to_world(unit));
  const Vector3f direction = normalize(place(shape.to_world(Vector3f(unit.x, unit.y, 0.5f))));
  hit.t = 1;
  return make_surface(shape, instance, {p - direction, direction, INFINITY}, hit);
}

/// Against differences of the normals close by.
void check_derivatives(const Shape& shape, const Instance* instance, const Point2f& at) {
  const Surface s = seen(shape, instance, at);
  const NormalDerivatives found = normal_derivatives(s);
  constexpr float h = 1e-3f;
  const auto difference = [&](float x, float y) {
    return (Vector3f(seen(shape, instance, {at.x + x, at.y + y}).shading.n) -
            Vector3f(seen(shape, instance, {at.x - x, at.y - y}).shading.n)) *
           (0.5f / h);
  };
  const Vector3f du = difference(h, 0), dv = difference(0, h);
  // Normals that are interpolated are not of unit length between the vertices.
  const auto across = [&](const Vector3f& v) {
    const Vector3f n(s.shading.n);
    return v - n * dot(n, v);
  };
  CHECK(length(across(found.du) - du) < 2e-2f * (1 + length(du)));
  CHECK(length(across(found.dv) - dv) < 2e-2f * (1 + length(dv)));
}

}  // namespace

TEST_CASE("the normal's derivatives are how it turns along the surface's tangents") {
  Instance instance;
  instance.to_world = Transform(Matrix4::translate(1, 2, -3) * Matrix4::rotate(70, 2, 1, 0) *
                                Matrix4::scale(3, 3, 3));
  for (const bool flip : {false, true})
    for (const Instance* i :
         {static_cast<const Instance*>(nullptr), static_cast<const Instance*>(&instance)}) {
      for (const Point2f& at : {Point2f{0.1f, 0.2f}, Point2f{0.37f, 0.5f}, Point2f{0.8f, 0.8f}}) {
        Shape ball = analytic(ShapeKind::sphere, turned(Matrix4::scale(2, 1, 0.7)), flip);
        Shape tube = analytic(ShapeKind::cylinder, turned(Matrix4::scale(0.5, 0.8, 2)), flip);
        for (Shape* shape : {&ball, &tube}) {
          shape->needs = {true, true};
          check_derivatives(*shape, i, at);
        }
      }
      TriangleMesh m;
      m.positions = {{0, 0, 0}, {1, 0.2f, 0.1f}, {0.3f, 0.8f, -0.2f}};
      m.normals = {normalize(Normal3f(0.1f, 0.0f, 0.9f)), normalize(Normal3f(0.05f, 0.1f, 0.9f)),
                   normalize(Normal3f(0.1f, -0.1f, 0.8f))};
      m.triangles = {{0, 1, 2}};
      Shape mesh;
      mesh.needs = {true, true};
      mesh.flip_normals = flip;
      mesh.mesh = std::make_shared<TriangleMesh>(m);
      check_derivatives(mesh, i, {0.3f, 0.4f});
      // The same by coordinates that are the barycentric ones, stretched and exchanged.
      const NormalDerivatives by_edges = normal_derivatives(seen(mesh, i, {0.3f, 0.4f}));
      m.uvs = {{0, 0}, {0, 2}, {4, 0}};
      mesh.mesh = std::make_shared<TriangleMesh>(m);
      const NormalDerivatives by_uv = normal_derivatives(seen(mesh, i, {0.3f, 0.4f}));
      CHECK(length(by_uv.dv * 2 - by_edges.du) < 1e-5f);
      CHECK(length(by_uv.du * 4 - by_edges.dv) < 1e-5f);
    }
}
