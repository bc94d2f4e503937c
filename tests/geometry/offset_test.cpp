// Rays that leave a surface must not find it again, whatever the scale of the scene.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include "geometry/accel.h"
#include "geometry/surface.h"
#include "math/sampler.h"
#include "math/warp.h"
#include "support/lamp.h"

using namespace duet;
using namespace duet::test;

namespace {

/// One shape or one instance of it, and rays that meet it.
struct Target {
  std::vector<Shape> shapes;
  std::vector<ShapeRange> groups;
  std::vector<Instance> instances;
  std::unique_ptr<Accel> accel;

  void build() {
    ShapeRange top{0, uint32_t(shapes.size())};
    if (!instances.empty()) groups.push_back(top), top.count = 0;
    accel = std::make_unique<Accel>(shapes, top, groups, instances, 1);
  }
  Surface surface(const Ray& ray, const Hit& hit) const {
    return make_surface(shapes[hit.shape], instances.empty() ? nullptr : &instances[0], ray, hit);
  }
};

Shape triangle(const Point3f& a, const Point3f& b, const Point3f& c) {
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->positions.reserve(4);
  mesh->positions = {a, b, c};
  mesh->triangles = {{0, 1, 2}};
  Shape s;
  s.mesh = mesh;
  return s;
}

Vector3f direction(Sampler& sampler) {
  return square_to_sphere(sampler.next_2d());
}

/// Sends rays at points of the target's shape and from each hit a
/// ray to both sides. `again(surface, direction)` is the distance at which the ray must meet the
/// target again, 0 if it may not, or infinity if rounding decides.
template <class Again>
void check(const Target& target, Sampler& sampler, const std::string& name, const Again& again) {
  const float radius = target.accel->bounds().radius();
  int hits = 0, wrong = 0;
  for (int i = 0; i < 2000; ++i) {
    const Shape& shape = target.shapes[0];
    const Point2f u = sampler.next_2d();
    Point3f p = shape.kind == ShapeKind::mesh ? sample_triangle(shape, 0, u).position
                                              : sample_analytic(shape, u).position;
    if (!target.instances.empty()) p = target.instances[0].to_world(p);
    const Point3f o = p + direction(sampler) * (radius * (i % 2 ? 1.5f : 40.0f));
    const Ray ray{o, normalize(p - o), INFINITY};
    Hit hit;
    if (!target.accel->closest_hit(ray, hit)) continue;
    const Surface s = target.surface(ray, hit);
    for (int k = 0; k < 4; ++k) {
      ++hits;
      Vector3f w = direction(sampler);
      // Every other direction grazes the surface.
      if (k & 1) w = normalize(w - Vector3f(s.ng) * (dot(s.ng, w) * 0.99f));
      const float expected = again(s, w);
      if (std::isinf(expected)) continue;
      Hit next;
      const bool found = target.accel->closest_hit(spawn_ray(s, w), next);
      wrong += expected == 0 ? found : !found || std::abs(next.t - expected) > 0.03f * expected;
    }
  }
  CHECK_MESSAGE(hits > 2000, fmt::format("{}: {} hits", name, hits));
  CHECK_MESSAGE(wrong == 0, fmt::format("{}: {} of {} rays", name, wrong, hits));
}

const auto never = [](const Surface&, const Vector3f&) { return 0.0f; };

/// A ray into a sphere or cylinder must leave it after a chord.
void check_round(Target& target, Sampler& sampler, const Matrix4& place, float radius, bool sphere,
                 const std::string& name) {
  target.build();
  const Transform transform(place);
  check(target, sampler, name, [&](const Surface& s, const Vector3f& w) {
    const float c = -dot(s.ng, w);
    if (c < 0.3f) return c <= 0 ? 0.0f : INFINITY;
    if (sphere) return 2 * c * radius;
    // A chord of the circle, unless the ray leaves through the open ends.
    const Vector3f l = transform.inverse(w);
    const Point3f p = transform.inverse(s.position);
    const float chord = -2 * (p.x * l.x + p.y * l.y) / (l.x * l.x + l.y * l.y);
    const float z = p.z + l.z * chord;
    if (std::abs(z) < 0.02f || std::abs(z - 1) < 0.02f) return INFINITY;
    return z > 0 && z < 1 ? chord : 0.0f;
  });
}

/// Calls f(scale, transform to a place away from the origin, name of a case).
template <class F>
void at_all_scales(const F& f) {
  for (const double scale : {1e-3, 1.0, 1e3, 1e6}) {
    const Matrix4 place = Matrix4::translate(3 * scale, -5 * scale, 7 * scale) *
                          Matrix4::rotate(40, 1, 2, 3) * Matrix4::scale(scale, scale, scale);
    f(scale, place, [scale](const char* what) { return fmt::format("{} at {}", what, scale); });
  }
}

Matrix4 shrunk(const Matrix4& place, double size) {
  return place * Matrix4::scale(size, size, size);
}

}  // namespace

TEST_CASE("rays do not find the triangle again that they leave") {
  Sampler sampler(SampleSequence::independent, 5, 0, 0);
  at_all_scales([&](double scale, const Matrix4&, const auto& name) {
    const auto at = [&](double x, double y, double z) {
      return Point3f(float(x * scale), float(y * scale), float(z * scale));
    };
    Target large, small, slim;
    large.shapes.push_back(triangle(at(-9, 2, 4), at(7, 3, -5), at(1, -8, 6)));
    small.shapes.push_back(triangle(at(9, 2, 4), at(9.01, 2.004, 4), at(9, 2.007, 4.009)));
    slim.shapes.push_back(triangle(at(-9, 2, 4), at(7, 3, -5), at(-8, 2.1, 3.45)));
    for (Target* t : {&large, &small, &slim}) t->build();
    check(large, sampler, name("large triangle"), never);
    check(small, sampler, name("small, far triangle"), never);
    check(slim, sampler, name("slim triangle"), never);
  });
}

TEST_CASE("rays do not find the analytic shape again that they leave") {
  Sampler sampler(SampleSequence::independent, 6, 0, 0);
  at_all_scales([&](double scale, const Matrix4& place, const auto& name) {
    for (const double size : {1.0, 0.01}) {
      const Matrix4 m = shrunk(place, size);
      Target disk, sphere, cylinder;
      disk.shapes.push_back(analytic(ShapeKind::disk, m));
      disk.build();
      check(disk, sampler, name("disk"), never);
      sphere.shapes.push_back(analytic(ShapeKind::sphere, m));
      cylinder.shapes.push_back(analytic(ShapeKind::cylinder, m));
      check_round(sphere, sampler, m, float(size * scale), true, name("sphere"));
      check_round(cylinder, sampler, m, float(size * scale), false, name("cylinder"));
    }
  });
}

TEST_CASE("rays do not find the instance again that they leave") {
  Sampler sampler(SampleSequence::independent, 7, 0, 0);
  at_all_scales([&](double scale, const Matrix4& place, const auto& name) {
    for (const double size : {1.0, 0.02}) {
      const Matrix4 m = shrunk(place, size);
      Target flat, sphere;
      flat.shapes.push_back(triangle({-9, 2, 4}, {7, 3, -5}, {1, -8, 6}));
      sphere.shapes.push_back(analytic(ShapeKind::sphere, Matrix4{}));
      for (Target* t : {&flat, &sphere})
        t->instances.push_back({0, Transform(m), float(size * scale)});
      flat.build();
      check(flat, sampler, name("instanced triangle"), never);
      check_round(sphere, sampler, m, float(size * scale), true, name("instanced sphere"));
    }
  });
}
