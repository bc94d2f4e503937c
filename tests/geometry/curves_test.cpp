#include "geometry/curves.h"

#include <doctest/doctest.h>

#include <cmath>

#include "geometry/accel.h"
#include "geometry/surface.h"

using namespace duet;

namespace {

/// Two B-splines or polylines, as in the file that Mitsuba 3.9.1 was asked about.
CurveSet two_curves(CurveKind kind) {
  CurveSet c;
  c.kind = kind;
  c.points = {{{-1, 0, 0}, 0.1f}, {{-0.3f, 0, 0.2f}, 0.1f}, {{0.4f, 0.1f, 0}, 0.2f},
              {{1, 0, 0}, 0.05f}, {{1.5f, 0.3f, 0}, 0.05f}, {{-1, 1, 0}, 0.1f},
              {{0, 1, 0}, 0.1f},  {{1, 1.2f, 0}, 0.2f},     {{2, 1, 0}, 0.1f}};
  c.segments = kind == CurveKind::linear ? std::vector<uint32_t>{0, 1, 2, 3, 5, 6, 7}
                                         : std::vector<uint32_t>{0, 1, 5};
  return c;
}

struct Tubes {
  std::vector<Shape> shapes{1};
  std::vector<ShapeRange> groups;
  std::vector<Instance> instances;
  std::unique_ptr<Accel> accel;

  explicit Tubes(CurveSet curves) {
    shapes[0].kind = ShapeKind::curves;
    shapes[0].curves = std::make_shared<CurveSet>(std::move(curves));
    shapes[0].needs = {.uv = true, .tangents = true};
    accel = std::make_unique<Accel>(shapes, ShapeRange{0, 1}, groups, instances, 1);
  }
  bool hit(const Ray& ray, Surface& s, float& t) const {
    Hit h;
    if (!accel->closest_hit(ray, h)) return false;
    t = h.t;
    s = make_surface(shapes[0], nullptr, ray, h);
    return true;
  }
};

bool near(const Vector3f& a, const Vector3f& b) {
  return length(a - b) < 2e-4f * (1 + length(b));
}

/// Where a ray of unit direction is level with the first point of a ribbon of one segment that it
/// meets by the definition of pbrt-v4: the segment is divided into eight pieces, and these into
/// powers of two of stretches by how much they bend. Infinite if there is none.
double pbrt_distance(const CurveSet& curves, const Ray& ray) {
  const Frame frame{Normal3f(ray.direction)};
  const auto seen = [&](const Vector3f& v) { return frame.to_local(v); };
  const auto at = [&](float u) { return seen(curve_center(curves, 0, u).position - ray.origin); };
  const auto slope = [&](float u) { return seen(curve_center(curves, 0, u).first); };
  const auto dot2 = [](const Vector3f& a, const Vector3f& b) { return a.x * b.x + a.y * b.y; };
  const float width =
      2 * std::max(curve_center(curves, 0, 0).radius, curve_center(curves, 0, 1).radius);
  double nearest = INFINITY;
  for (int piece = 0; piece < 8; ++piece) {
    const float u0 = float(piece) / 8, u1 = u0 + 1.0f / 8;
    Vector3f x = at(u1) - at(u0);
    x.z = 0;
    x = normalize(x);
    float bend = 0;
    for (const float u : {u0, u1}) {
      // The second differences of the control points of the piece.
      const Vector3f d = seen(curve_center(curves, 0, u).second) * (1.0f / (64 * 6));
      bend = std::max({bend, std::abs(dot2(d, x)), std::abs(d.x * x.y - d.y * x.x), std::abs(d.z)});
    }
    const double ratio = std::sqrt(2.0) * 6 * double(bend) / (8 * 0.05 * double(width));
    const int steps = 1 << std::clamp(int(std::lround(std::log2(ratio))) / 2, 0, 10);
    for (int k = 0; k < steps; ++k) {
      const float v0 = u0 + float(k) / float(8 * steps), v1 = v0 + 1 / float(8 * steps);
      const Vector3f p0 = at(v0), p1 = at(v1);
      if (dot2(p0, slope(v0)) > 0 || dot2(p1, slope(v1)) < 0) continue;
      const Vector3f chord = p1 - p0;
      const float w = std::clamp(-dot2(p0, chord) / dot2(chord, chord), 0.0f, 1.0f);
      const float u = v0 + (v1 - v0) * w, radius = curve_center(curves, 0, u).radius;
      const Vector3f p = at(u);
      if (dot2(p, p) <= radius * radius && p.z > 0) nearest = std::min(nearest, double(p.z));
    }
  }
  return nearest;
}

/// What Mitsuba 3.9.1 (scalar_rgb) says of a ray.
struct Answer {
  Point3f o;
  Vector3f d;
  float t;
  Normal3f n;
  Point2f uv;
  Vector3f s, dp_du;
};

void compare(const Tubes& tubes, const Answer& a, bool tangents) {
  CAPTURE(a.o.x);
  CAPTURE(a.o.y);
  Surface s;
  float t;
  REQUIRE(tubes.hit({a.o, a.d, INFINITY}, s, t));
  CHECK(t == doctest::Approx(a.t).epsilon(1e-4));
  CHECK(near(Vector3f(s.ng), Vector3f(a.n)));
  CHECK(near(Vector3f(s.shading.n), Vector3f(a.n)));
  CHECK(s.uv.x == doctest::Approx(a.uv.x).epsilon(1e-3));
  CHECK(s.uv.y == doctest::Approx(a.uv.y).epsilon(1e-3));
  CHECK(near(s.shading.s, a.s));
  if (!tangents) return;
  CHECK(near(s.dp_du, a.dp_du));
}

}  // namespace

TEST_SUITE("curves") {
  TEST_CASE("surfaces of B-splines are those of Mitsuba") {
    const Tubes tubes(two_curves(CurveKind::bspline));
    compare(tubes,
            {{0.1f, 0, 5},
             {0, 0, -1},
             4.771463f,
             {0.127414f, -0.34128f, 0.931286f},
             {0.307279f, 0.17742f},
             {0.0184774f, -0.937959f, -0.346254f},
             {0.0172577f, -0.876042f, -0.323396f}},
            true);
    compare(tubes,
            {{0.7f, 1.15f, 5},
             {0, 0, -1},
             4.844063f,
             {-0.0637955f, 0.194749f, 0.978776f},
             {0.217953f, 0.900976f},
             {0.0901042f, -0.975644f, 0.199998f},
             {0.0901027f, -0.975628f, 0.199995f}},
            true);
  }

  TEST_CASE("surfaces of linear curves are those of Mitsuba") {
    const Tubes tubes(two_curves(CurveKind::linear));
    compare(tubes,
            {{0.1f, 0, 5},
             {0, 0, -1},
             4.765401f,
             {0.170264f, -0.348158f, 0.921844f},
             {0.310698f, 0.219159f},
             {0.984916f, 0.0308447f, -0.170264f},
             {}},
            false);
    compare(tubes,
            {{0.7f, 1.15f, 5},
             {0, 0, -1},
             4.829265f,
             {-0.107345f, 0.0367225f, 0.993543f},
             {0.240869f, 0.816921f},
             {0.99422f, 0.00197737f, 0.107345f},
             {}},
            false);
    // The spherical end.
    compare(tubes,
            {{-1.05f, 0, 5},
             {0, 0, -1},
             4.913397f,
             {-0.499999f, 0, 0.866026f},
             {0.25f, 0},
             {0.866026f, 0, 0.499999f},
             {}},
            false);
  }

  TEST_CASE("rays from inside see nothing, unless the hair is of 0.6") {
    for (const CurveKind kind : {CurveKind::linear, CurveKind::bspline}) {
      CurveSet curves = two_curves(kind);
      const Ray within{{0.4f, 0.06f, 0.04f}, {0.1f, 0.1f, 1}, INFINITY};
      Surface s;
      float t;
      CHECK_FALSE(Tubes(curves).hit(within, s, t));
      CHECK_FALSE(Tubes(curves).accel->occluded(within));
      curves.outside_only = false;
      const Tubes both(curves);
      CHECK(both.hit(within, s, t));
      CHECK(both.accel->occluded(within));
    }
  }

  TEST_CASE("the centre's derivatives are those of its position and radius") {
    const CurveSet c = two_curves(CurveKind::bspline);
    for (const float u : {0.1f, 0.5f, 0.9f}) {
      const float h = 1e-2f;
      const CurveCenter a = curve_center(c, 1, u - h), b = curve_center(c, 1, u + h),
                        m = curve_center(c, 1, u);
      CHECK(near((b.position - a.position) * (0.5f / h), m.first));
      CHECK((b.radius - a.radius) / (2 * h) == doctest::Approx(m.radius_slope).epsilon(2e-3));
      CHECK(near((b.first - a.first) * (0.5f / h), m.second));
    }
  }

  TEST_CASE("a step along a B-spline's derivatives changes the texture coordinates by as much") {
    const Tubes tubes(two_curves(CurveKind::bspline));
    int found = 0;
    for (int i = 0; i < 400; ++i) {
      const float x = -0.2f + 0.007f * float(i % 100), angle = 1.5f * float(i);
      const Vector3f d(0.2f, std::cos(angle), std::sin(angle));
      Surface s;
      float t = 0;
      if (!tubes.hit({Point3f(x, 0, 0.05f) - d * 5, normalize(d), INFINITY}, s, t)) continue;
      if (s.uv.x < 0.05f || s.uv.x > 0.95f) continue;
      const auto slope = [&](const Vector3f& derivative, float step, Point2f& out) {
        Point2f at[2];
        for (const int k : {0, 1}) {
          Surface moved;
          const Point3f p = s.position + derivative * (k ? step : -step);
          const Vector3f n(s.ng);
          if (!tubes.hit({p + n * 0.05f, -n, INFINITY}, moved, t)) return false;
          if (moved.primitive != s.primitive) return false;
          at[k] = moved.uv;
        }
        out = (at[1] - at[0]) * (0.5f / step);
        return true;
      };
      Point2f u, v;
      if (!slope(s.dp_du, 0.01f, u) || !slope(s.dp_dv, 0.003f, v)) continue;
      INFO(s.uv.x << " " << s.uv.y);
      CHECK(std::abs(u.x - 1) < 0.02f);
      CHECK(std::abs(u.y) < 0.02f);
      CHECK(std::abs(v.x) < 0.02f);
      CHECK(std::abs(v.y - 1) < 0.02f);
      ++found;
    }
    CHECK(found > 50);
  }

  TEST_CASE("segments join smoothly") {
    const CurveSet c = two_curves(CurveKind::bspline);
    const CurveCenter a = curve_center(c, 0, 1), b = curve_center(c, 1, 0);
    CHECK(near(a.position - b.position, Vector3f(0)));
    CHECK(near(a.first, b.first));
    CHECK(near(a.second, b.second));
    CHECK(a.radius == doctest::Approx(b.radius));
  }

  TEST_CASE("a surface point lies on its tube, and rays that leave it do not meet it again") {
    for (const CurveKind kind : {CurveKind::linear, CurveKind::bspline}) {
      const Tubes tubes(two_curves(kind));
      int hits = 0;
      for (int i = 0; i < 2000; ++i) {
        const float angle = 0.37f * float(i), y = -0.3f + 0.001f * float(i);
        const Ray ray{{-1.5f + 0.002f * float(i), y, 3},
                      normalize(Vector3f(0.3f * std::cos(angle), 0.3f * std::sin(angle), -1)),
                      INFINITY};
        Surface s;
        float t;
        if (!tubes.hit(ray, s, t)) continue;
        ++hits;
        CHECK(length(s.position - (ray.origin + ray.direction * t)) < 1e-3f);
        CHECK(dot(Vector3f(s.ng), ray.direction) < 0);
        // Straight away from the surface: nothing but another tube could be there.
        Hit again;
        const Ray away = spawn_ray(s, Vector3f(s.ng));
        if (tubes.accel->closest_hit(away, again)) CHECK(again.t > 0.05f);
      }
      CHECK(hits > 100);
    }
  }

  TEST_CASE("ribbons face each ray, and new rays start clear of them") {
    CurveSet c;
    c.kind = CurveKind::bspline;
    c.profile = CurveProfile::ribbon;
    c.points = {{{-3, 0, 0}, 0.1f}, {{-1, 0, 0}, 0.1f}, {{1, 0, 0}, 0.1f}, {{3, 0, 0}, 0.1f}};
    c.segments = {0};
    const Tubes flat(c);
    c.profile = CurveProfile::round_ribbon;
    const Tubes round(c);
    Surface s;
    float t;
    REQUIRE(flat.hit({{0, 0.05f, 5}, {0, 0, -1}, INFINITY}, s, t));
    CHECK(t == doctest::Approx(5));
    CHECK(near(Vector3f(s.ng), {0, 0, 1}));
    CHECK(near(Vector3f(s.shading.n), {0, 0, 1}));
    CHECK(s.uv.x == doctest::Approx(0.5).epsilon(1e-3));
    CHECK(s.uv.y == doctest::Approx(0.25).epsilon(1e-3));
    CHECK(near(s.dp_dv, {0, -0.2f, 0}));
    CHECK_FALSE(flat.hit({{0, 0.101f, 5}, {0, 0, -1}, INFINITY}, s, t));
    // From the side it is as wide, and its normal is across the curve, however the ray comes.
    REQUIRE(flat.hit({{5, 5, 0.05f}, normalize(Vector3f(-1, -1, 0)), INFINITY}, s, t));
    CHECK(near(Vector3f(s.ng), {0, 1, 0}));
    CHECK(s.position.x == doctest::Approx(0).scale(1));
    // From close by, too.
    REQUIRE(flat.hit({{0, 0.05f, 0.02f}, {0, 0, -1}, INFINITY}, s, t));
    CHECK(t == doctest::Approx(0.02).epsilon(1e-3));
    CHECK(flat.accel->occluded({{0, 0.05f, 0.02f}, {0, 0, -1}, 0.03f}));
    CHECK_FALSE(flat.accel->occluded({{0, 0.05f, 0.02f}, {0, 0, -1}, 0.01f}));
    CHECK_FALSE(flat.accel->occluded({{0, 0.05f, -0.001f}, {0, 0, -1}, INFINITY}));
    // Whatever the length of the direction.
    CHECK(flat.accel->occluded({{0, 0.05f, 0.02f}, {0, 0, -0.05f}, 1}));
    CHECK_FALSE(flat.accel->occluded({{0, 0.05f, 0.02f}, {0, 0, -0.01f}, 1}));
    // A quarter from its edge the normal of the other kind has turned by an eighth of a circle.
    REQUIRE(round.hit({{0, 0.05f, 5}, {0, 0, -1}, INFINITY}, s, t));
    const float h = std::sqrt(0.5f);
    CHECK(near(Vector3f(s.ng), {0, -h, h}));
    CHECK(near(s.dp_dv, Vector3f(0, -h, -h) * 0.2f));
    for (int i = 0; i < 200; ++i) {
      const float z = 1 - 2 * (float(i) + 0.5f) / 200, phi = 2.4f * float(i);
      const float r = std::sqrt(1 - z * z);
      const Vector3f w(r * std::cos(phi), r * std::sin(phi), z);
      if (dot(w, s.ng) <= 0) continue;
      CHECK_FALSE(round.accel->occluded(spawn_ray(s, w)));
    }
  }

  TEST_CASE("ribbons are met where the curve is within half their width of the ray") {
    CurveSet c = two_curves(CurveKind::bspline);
    c.profile = CurveProfile::ribbon;
    const Tubes ribbons(c);
    int met = 0;
    for (int i = 0; i < 4000; ++i) {
      const float a = std::fmod(float(i) * 0.7548777f, 1.0f),
                  b = std::fmod(float(i) * 0.5698403f, 1.0f);
      const Ray ray{
          {3 * a - 1.5f, 2 * b - 0.5f, 4}, normalize(Vector3f(0.2f, a - 0.5f, -2)), INFINITY};
      float nearest = INFINITY;  // distance over the radius
      bool inner = false;        // not at the end of a segment
      for (uint32_t segment = 0; segment < c.segments.size(); ++segment)
        for (int k = 0; k <= 400; ++k) {
          const CurveCenter p = curve_center(c, segment, float(k) / 400);
          const float d = length(cross(p.position - ray.origin, ray.direction)) / p.radius;
          if (d < nearest) nearest = d, inner = k > 8 && k < 392;
        }
      Surface s;
      float t;
      const bool hit = ribbons.hit(ray, s, t);
      met += hit;
      // Ends are cut across the curve.
      if (nearest < 0.97f && inner) CHECK(hit);
      if (nearest > 1.03f) CHECK_FALSE(hit);
    }
    CHECK(met > 100);
  }

  TEST_CASE("wide ribbons are met where pbrt's definition says") {
    for (const float width : {1.0f, 0.2f, 0.12f, 0.07f}) {
      INFO(width);
      CurveSet c;
      c.kind = CurveKind::bspline;
      c.profile = CurveProfile::ribbon;
      // The Bézier curve (0, 0, 0), (0, −1, 1.5), (1.4, 1, 2), (1.2, 0, 0.2), which narrows to 0.3
      // of its width.
      c.points = {{{2.8f, 9, -6.5f}, 0.85f * width},
                  {{-1.4f, -3, 1}, 0.5f * width},
                  {{2.8f, 3, 2.5f}, 0.15f * width},
                  {{-2.6f, -9, -9.8f}, -0.2f * width}};
      c.segments = {0};
      const Tubes ribbon(c);
      int met = 0, differ = 0;
      for (int i = 0; i < 5000; ++i) {
        const float a = std::fmod(float(i) * 0.7548777f, 1.0f),
                    b = std::fmod(float(i) * 0.5698403f, 1.0f);
        // From below, about along the beginning.
        const Ray ray{{1.5f * a - 0.5f, b - 0.5f, -0.3f},
                      normalize(Vector3f(0.5f - a, -b - 0.3f, 1.5f)),
                      INFINITY};
        const double expected = pbrt_distance(c, ray);
        Surface s;
        float t;
        const bool hit = ribbon.hit(ray, s, t);
        met += hit;
        // At edges rounding decides.
        differ += hit != std::isfinite(expected) || (hit && std::abs(double(t) - expected) > 1e-4);
      }
      CHECK(met > 100);
      CHECK(differ <= 2);
    }
  }
}
