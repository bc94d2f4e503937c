#include "scene/light_media.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "math/warp.h"

namespace duet {

namespace {

/// Rays in this number of directions decide what surrounds a point.
constexpr int kDirections = 32;
/// No ray meets more surfaces.
constexpr int kMostSurfaces = 4096;

/// Directions all around, none of them along an axis. Source: Swinbank & Purser, "Fibonacci grids",
/// 2006.
Vector3f direction(int i) {
  constexpr float kGoldenRatio = 1.6180339887f;
  const float z = 1 - (2 * float(i) + 1) / kDirections, r = std::sqrt(1 - z * z);
  const float phi = 2 * kPi * (float(i) + 0.3f) * kGoldenRatio;
  return {r * std::cos(phi), r * std::sin(phi), z};
}

/// Visits the surfaces along a ray that separate media, until `visit(surface)` returns false.
template <class Visit>
void boundaries(const Scene& scene, Ray ray, Visit visit) {
  for (int i = 0; i < kMostSurfaces; ++i) {
    Hit hit;
    if (!scene.accel->closest_hit(ray, hit)) return;
    const Surface s = scene.surface(ray, hit);
    if (s.shape->separates_media() && !visit(s)) return;
    ray = spawn_ray(s, ray.direction);
  }
}

struct Boundary {
  Point3f position;
  const Medium* medium_before;  ///< on the side that a ray comes from, or null
};

/// The first surface that separates media on the way from `p` along the unit direction `w`.
std::optional<Boundary> first_boundary(const Scene& scene, const Point3f& p, const Vector3f& w) {
  std::optional<Boundary> first;
  boundaries(scene, {p, w, INFINITY}, [&](const Surface& s) {
    first = {s.position, scene.medium_beyond(s, -w)};
    return false;
  });
  return first;
}

}  // namespace

const Medium* outermost_medium(const Scene& scene) {
  const Point3f origin = scene.camera->sample_ray({0.5f, 0.5f}, {0.5f, 0.5f}).origin;
  std::map<const Medium*, int> votes;
  for (int i = 0; i < kDirections; ++i) {
    const Medium* medium = scene.camera_medium;
    const Vector3f w = direction(i);
    boundaries(scene, {origin, w, INFINITY}, [&](const Surface& s) {
      medium = scene.medium_beyond(s, w);
      return true;
    });
    ++votes[medium];
  }
  // Surfaces that are not closed may lead some of the rays astray.
  const Medium* most = nullptr;
  for (const auto& m : scene.media)
    if (votes[m.get()] > votes[most]) most = m.get();
  return most;
}

const Medium* medium_at(const Scene& scene, const Point3f& p) {
  const Medium* medium = scene.outermost_medium;
  float nearest = INFINITY;
  for (int i = 0; i < kDirections; ++i)
    if (const auto boundary = first_boundary(scene, p, direction(i)))
      if (const float d = distance(boundary->position, p); d < nearest) {
        nearest = d;
        medium = boundary->medium_before;
      }
  return medium;
}

namespace {

/// Beyond this number of triangles a boundary is not examined one by one.
constexpr size_t kMostTriangles = 100000;

Bounds bounds_of(const Shape& shape) {
  if (shape.curves) return curve_bounds(*shape.curves);
  if (!shape.mesh) return analytic_bounds(shape);
  Bounds b;
  for (const Point3f& p : shape.mesh->positions) b.extend(p);
  return b;
}

std::array<Point3f, 8> corners(const Bounds& b) {
  std::array<Point3f, 8> points;
  for (unsigned i = 0; i < 8; ++i)
    points[i] = {(i & 1 ? b.upper : b.lower).x, (i & 2 ? b.upper : b.lower).y,
                 (i & 4 ? b.upper : b.lower).z};
  return points;
}

bool disjoint(const Bounds& a, const Bounds& b) {
  return a.upper.x < b.lower.x || b.upper.x < a.lower.x || a.upper.y < b.lower.y ||
         b.upper.y < a.lower.y || a.upper.z < b.lower.z || b.upper.z < a.lower.z;
}

/// Whether the plane of a triangle passes through the box.
bool plane_cuts(const Bounds& box, const Point3f& a, const Point3f& b, const Point3f& c) {
  const Vector3f n = cross(b - a, c - a);
  bool before = false, behind = false;
  for (const Point3f& p : corners(box)) {
    const float side = dot(n, p - a);
    before |= side >= 0;
    behind |= side <= 0;
  }
  return before && behind;
}

/// False only if no point of the surface lies in the box.
bool may_reach_into(const Shape& surface, const Bounds& box) {
  if (disjoint(bounds_of(surface), box)) return false;
  if (surface.kind == ShapeKind::sphere) {
    // A box whose corners are all inside a ball is inside as a whole.
    for (const Point3f& p : corners(box)) {
      if (!(length_squared(surface.to_world.inverse(p) - Point3f(0)) < 1)) return true;
    }
    return false;
  }
  if (!surface.mesh || surface.mesh->triangles.size() > kMostTriangles) return true;
  for (const auto& t : surface.mesh->triangles) {
    const std::vector<Point3f>& p = surface.mesh->positions;
    Bounds b;
    for (const uint32_t v : t) b.extend(p[v]);
    if (!disjoint(b, box) && plane_cuts(box, p[t[0]], p[t[1]], p[t[2]])) return true;
  }
  return false;
}

/// A point on the surface, or within its box where no formula gives one.
Point3f point_of(const Shape& surface) {
  if (surface.mesh) {
    const TriangleMesh& mesh = *surface.mesh;
    uint32_t largest = 0;
    for (uint32_t i = 1; i < mesh.triangles.size(); ++i)
      if (triangle_area(mesh, i) > triangle_area(mesh, largest)) largest = i;
    return point_on_triangle(surface, largest, {1 / 3.0f, 1 / 3.0f}).position;
  }
  const bool has_formula = surface.kind == ShapeKind::sphere || surface.kind == ShapeKind::disk ||
                           surface.kind == ShapeKind::cylinder;
  return has_formula ? sample_analytic(surface, {0.37f, 0.53f}).position
                     : bounds_of(surface).center();
}

/// A surface that separates media and may reach into the bounding box of a shape, or null.
const Shape* boundary_across(const Scene& scene, const Shape& shape) {
  Bounds box = bounds_of(shape);
  // Rays leave a light at a small distance from it.
  const Vector3f margin(1e-3f * (box.radius() + length(box.center() - Point3f(0))));
  box = {box.lower - margin, box.upper + margin};
  for (uint32_t i = 0; i < scene.top.count; ++i) {
    const Shape& s = scene.shapes[scene.top.first + i];
    if (s.separates_media() && may_reach_into(s, box)) return &s;
  }
  return nullptr;
}

}  // namespace

LightMedium medium_before(const Scene& scene, const Light& light) {
  if (is_infinite(light.kind())) return {scene.outermost_medium};
  for (const Shape& shape : scene.shapes)
    if (scene.light_on(shape) == &light) {
      if (shape.separates_media())
        return {shape.exterior == kNone ? nullptr : scene.media[shape.exterior].get()};
      if (const Shape* boundary = boundary_across(scene, shape))
        return {nullptr, true, point_of(*boundary)};
    }
  const auto ray = light.sample_emission({0.37f, 0.53f}, {0.61f, 0.29f});
  return {ray ? medium_at(scene, ray->ray.origin) : scene.outermost_medium};
}

const Medium* medium_at_emission(const Scene& scene, const LightMedium& light, const Point3f& p) {
  if (!light.depends_on_point) return light.medium;
  const auto boundary = first_boundary(scene, p, normalize(light.boundary_point - p));
  return boundary ? boundary->medium_before : scene.outermost_medium;
}

}  // namespace duet
