// Bump maps as Mitsuba and as pbrt have them, by the normals that they make.
#include <doctest/doctest.h>

#include "geometry/curvature.h"
#include "materials/materials.h"
#include "materials/wrappers.h"
#include "support/test_material.h"

using namespace duet;

namespace {

/// The normal of a mirror under bumps with this height and slope.
Vector3f bumped(const Surface& s, float height, const Point2f& slope, bool follows_curvature) {
  const Conductor mirror{ConductorOptions{}};
  const test::FlatTexture texture(Spectrum(height), slope);
  const BumpMap bumps({0, &texture}, 1, follows_curvature, {false, false, false}, mirror);
  const Vector3f wo = normalize(Vector3f(s.shading.n));
  const auto sample = bumps.bind(s, wo).sample(0.5f, {0.5f, 0.5f}, Transport::radiance);
  REQUIRE(sample.has_value());
  return normalize(wo + sample->wi);
}

Vector3f crossed(const Vector3f& a, const Vector3f& b, const Surface& s) {
  const Vector3f n = normalize(cross(a, b));
  return dot(n, Vector3f(s.ng)) < 0 ? -n : n;
}

void check_near(const Vector3f& a, const Vector3f& b) {
  CHECK(length(a - b) < 1e-4f);
}

Surface on_ball(float radius, bool flip, Shape& shape) {
  shape.kind = ShapeKind::sphere;
  const Matrix4 m = Matrix4::scale(radius, radius, radius);
  shape.to_world = Transform(m);
  shape.to_local = *m.inverse();
  shape.needs = {true, true};
  shape.flip_normals = flip;
  const Vector3f d = normalize(Vector3f(-1, -2, -1.5f));
  Hit hit{};
  hit.t = 5 - radius;
  return make_surface(shape, nullptr, {Point3f(0) - d * 5.0f, d, INFINITY}, hit);
}

Surface on_triangle(BumpTangents tangents, bool with_normals, bool flip, Shape& shape) {
  TriangleMesh m;
  m.positions = {{0, 0, 0}, {2, 0, 0}, {0.5f, 1, 0}};
  const Normal3f n = normalize(Normal3f(0.2f, -0.1f, 1));
  if (with_normals) m.normals = {n, n, n};
  // Mirrored, and of another scale along each side.
  m.uvs = {{0, 0}, {0.5f, 0}, {0, -3}};
  m.triangles = {{0, 1, 2}};
  m.bump_tangents = tangents;
  shape.mesh = std::make_shared<TriangleMesh>(m);
  shape.needs = {true, true};
  shape.flip_normals = flip;
  Hit hit{};
  hit.u = hit.v = 0.25f;
  return make_surface(shape, nullptr, {}, hit);
}

}  // namespace

TEST_CASE("bumps on a ball: pbrt's height makes it larger, Mitsuba's does not") {
  constexpr float kRadius = 0.8f, kHeight = 0.15f;
  const Point2f slope{0.4f, -0.3f};
  for (const bool flip : {false, true}) {
    Shape shape;
    const Surface s = on_ball(kRadius, flip, shape);
    const Vector3f n(s.shading.n);
    const auto expected = [&](float grown) {
      return crossed(s.dp_du * grown + n * slope.x, s.dp_dv * grown + n * slope.y, s);
    };
    check_near(bumped(s, kHeight, slope, true),
               expected(1 + (flip ? -kHeight : kHeight) / kRadius));
    check_near(bumped(s, kHeight, slope, false), expected(1));
  }
}

TEST_CASE("bumps on meshes with normals have the tangents of each version of pbrt") {
  const Point2f slope{0.3f, 0.2f};
  for (const bool flip : {false, true}) {
    const auto normal = [&](BumpTangents tangents, bool with_normals, const auto& base) {
      Shape shape;
      const Surface s = on_triangle(tangents, with_normals, flip, shape);
      const Vector3f n(s.shading.n);
      const auto [u, v] = base(s, n);
      check_near(bumped(s, 0, slope, true), crossed(u + n * slope.x, v + n * slope.y, s));
    };
    const auto across = [](const Vector3f& v, const Vector3f& n) { return v - n * dot(n, v); };
    const auto by_coordinates = [&](const Surface& s, const Vector3f& n) {
      return std::pair(across(s.dp_du, n), across(s.dp_dv, n));
    };
    normal(BumpTangents::derivatives, true, by_coordinates);
    // Normals that are flat are dropped before.
    for (const bool has_normals : {false, true})
      normal(BumpTangents::across_normals, has_normals, [&](const Surface& s, const Vector3f& n) {
        const Vector3f u = across(s.dp_du, n);
        return std::pair(u, cross(n, u));
      });
    normal(BumpTangents::unit_backwards, true, [&](const Surface& s, const Vector3f& n) {
      const Vector3f u = normalize(across(s.dp_du, n));
      return std::pair(-u, -cross(n, u));
    });
  }
}
