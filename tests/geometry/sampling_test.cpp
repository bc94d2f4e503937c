// Points on shapes: even where they should be, with the density that they claim.
#include <doctest/doctest.h>

#include "geometry/shape.h"
#include "math/sampler.h"
#include "support/lamp.h"
#include "support/statistics.h"

using namespace duet;
using namespace duet::test;

namespace {

constexpr double kPiD = 3.14159265358979323846;

/// A point of the unit shape by uniform parameters: longitude and height, or angle and squared
/// radius.
Point3f local_point(ShapeKind kind, double a, double b) {
  const double c = std::cos(2 * kPiD * a), s = std::sin(2 * kPiD * a);
  double r = 1, z = b;
  if (kind == ShapeKind::sphere) z = 1 - 2 * b, r = std::sqrt(1 - z * z);
  if (kind == ShapeKind::disk) r = std::sqrt(b), z = 0;
  return {float(r * c), float(r * s), float(z)};
}

Point2f parameters(ShapeKind kind, const Point3f& p) {
  const double angle = std::atan2(double(p.y), double(p.x)) / (2 * kPiD);
  double b = double(p.z);
  if (kind == ShapeKind::sphere) b = 0.5 * (1 - b);
  if (kind == ShapeKind::disk) b = double(p.x) * p.x + double(p.y) * p.y;
  return {float(angle < 0 ? angle + 1 : angle), float(b)};
}

Normal3f local_normal(ShapeKind kind, const Point3f& p) {
  if (kind == ShapeKind::disk) return {0, 0, 1};
  if (kind == ShapeKind::cylinder) return {p.x, p.y, 0};
  return Normal3f(p);
}

/// World-space area per unit square of the parameters, by differences.
double area_element(const Shape& s, double a, double b) {
  const double h = 1e-3;
  const auto at = [&](double x, double y) {
    const Point3f p = local_point(s.kind, x, y);
    const auto& r = s.to_world.rows();
    return std::array<double, 3>{
        double(r[0][0]) * p.x + double(r[0][1]) * p.y + double(r[0][2]) * p.z,
        double(r[1][0]) * p.x + double(r[1][1]) * p.y + double(r[1][2]) * p.z,
        double(r[2][0]) * p.x + double(r[2][1]) * p.y + double(r[2][2]) * p.z};
  };
  const auto x0 = at(a - h, b), x1 = at(a + h, b), y0 = at(a, b - h), y1 = at(a, b + h);
  double u[3], v[3];
  for (int i = 0; i < 3; ++i) {
    u[i] = (x1[size_t(i)] - x0[size_t(i)]) / (2 * h);
    v[i] = (y1[size_t(i)] - y0[size_t(i)]) / (2 * h);
  }
  return std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                    u[0] * v[1] - u[1] * v[0]);
}

}  // namespace

TEST_CASE("points of analytic shapes have the density that is claimed, also when stretched") {
  const Matrix4 skew = Matrix4::translate(1, 2, 3) * Matrix4::rotate(35, 3, 1, 2) *
                       Matrix4::scale(-1.3, 0.4, 2) * Matrix4::rotate(25, 1, 1, 0);
  for (const ShapeKind kind : {ShapeKind::sphere, ShapeKind::disk, ShapeKind::cylinder})
    for (const Matrix4& m : {Matrix4{}, skew}) {
      const Shape shape = analytic(kind, m);
      double worst = 0;
      const auto result = test::chi2_square(
          [&](Point2f u, Point2f& p) {
            const ShapePoint s = sample_analytic(shape, u);
            const Point3f local = shape.to_world.inverse(s.position);
            p = parameters(kind, local);
            const float pdf = pdf_analytic(shape, normalize(local_normal(kind, local))).value;
            worst = std::max(worst, double(std::abs(s.pdf.value / pdf - 1)));
            worst = std::max(worst,
                             double(std::abs(dot(s.ng, shape.to_world(local_normal(kind, local))) /
                                             length(shape.to_world(local_normal(kind, local)))) -
                                    1));
            return true;
          },
          [&](Point2f p) {
            const Normal3f n =
                normalize(local_normal(kind, local_point(kind, double(p.x), double(p.y))));
            return double(pdf_analytic(shape, n).value) *
                   area_element(shape, double(p.x), double(p.y));
          },
          {.nx = 20, .ny = 20, .sub = 6, .samples = 100000, .level = 1e-3});
      INFO("kind " << int(kind) << " area " << surface_area(shape));
      CHECK_MESSAGE(result.pass, result.message);
      CHECK(worst < 1e-4);
    }
}

TEST_CASE("points of a triangle are uniform") {
  Shape shape;
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->positions = {{1, 2, 3}, {4, 2, 1}, {0, 5, 2}};
  mesh->triangles = {{0, 1, 2}};
  shape.mesh = mesh;
  const Vector3f e1 = mesh->positions[1] - mesh->positions[0],
                 e2 = mesh->positions[2] - mesh->positions[0];
  const auto result = test::chi2_square(
      [&](Point2f u, Point2f& p) {
        const ShapePoint s = sample_triangle(shape, 0, u);
        // Barycentric coordinates from the position.
        const Vector3f d = s.position - mesh->positions[0];
        const float d11 = dot(e1, e1), d12 = dot(e1, e2), d22 = dot(e2, e2);
        const float det = d11 * d22 - d12 * d12;
        const float b1 = (dot(d, e1) * d22 - dot(d, e2) * d12) / det;
        const float b2 = (dot(d, e2) * d11 - dot(d, e1) * d12) / det;
        // Uniform on the triangle means that 1 − (1 − b1)² and b2 / (1 − b1) are uniform.
        p = {1 - sqr(1 - b1), b2 / (1 - b1)};
        return std::abs(s.pdf.value * triangle_area(*mesh, 0) - 1) < 1e-5f;
      },
      [](Point2f) { return 1.0; }, {.samples = 100000, .level = 1e-3});
  CHECK_MESSAGE(result.pass, result.message);
}

TEST_CASE("areas of shapes") {
  const auto area = [](ShapeKind kind, const Matrix4& m) {
    return surface_area(analytic(kind, m));
  };
  const Matrix4 turn = Matrix4::translate(5, 1, 2) * Matrix4::rotate(77, 2, -1, 1);
  CHECK(area(ShapeKind::sphere, turn * Matrix4::scale(3, 3, 3)) ==
        doctest::Approx(36 * kPiD).epsilon(1e-6));
  CHECK(area(ShapeKind::disk, turn * Matrix4::scale(3, 0.5, 7)) ==
        doctest::Approx(1.5 * kPiD).epsilon(1e-6));
  CHECK(area(ShapeKind::cylinder, turn * Matrix4::scale(3, 3, 0.5)) ==
        doctest::Approx(3 * kPiD).epsilon(1e-6));
  // A spheroid of semi-axes 2, 2, 1: 2π a² (1 + (1 − e²) / e · artanh e).
  const double e = std::sqrt(0.75);
  CHECK(area(ShapeKind::sphere, turn * Matrix4::scale(2, 2, -1)) ==
        doctest::Approx(2 * kPiD * 4 * (1 + 0.25 / e * std::atanh(e))).epsilon(1e-4));
  Shape box;
  box.mesh = std::make_shared<TriangleMesh>(make_cube());
  CHECK(surface_area(box) == doctest::Approx(24));
}
