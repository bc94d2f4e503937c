// A hit made into a shading point.
#pragma once

#include "geometry/shape.h"
#include "math/frame.h"

namespace duet {

/// All that materials and lights may ask about a point of a surface.
struct Surface {
  Point3f position;
  /// Unit geometric normal, turned to the side of the shading normal.
  Normal3f ng;
  /// Distance by which a ray that leaves has to step off along ±ng, so that rounding cannot make it
  /// hit the surface again: a few units in the last place of the largest coordinate involved.
  float offset;
  Frame shading;
  Point2f uv;             ///< valid if the shape needs uv
  Vector3f dp_du, dp_dv;  ///< valid if the shape needs tangents
  Point2f barycentric;    ///< (u, v) of the hit, on meshes and curves
  uint32_t primitive;
  const Shape* shape;
};

/// Whether the shading and the geometric normal see a direction on different sides.
inline bool sides_differ(const Vector3f& ng, const Vector3f& ns, const Vector3f& w) {
  return dot(ng, w) * dot(ns, w) <= 0;
}
inline bool sides_differ(const Surface& s, const Vector3f& w) {
  return sides_differ(Vector3f(s.ng), Vector3f(s.shading.n), w);
}

/// Completes a hit of a mesh that is not instanced.
Surface make_mesh_surface(const Shape& shape, const Hit& hit);

/// Completes a hit of `ray`. `instance` is null for shapes that are not instanced.
Surface make_surface(const Shape& shape, const Instance* instance, const Ray& ray, const Hit& hit);

/// What textures look up at a point that was sampled on a shape: it has no normals or tangents.
inline Surface textured_point(const Shape& shape, const ShapePoint& p) {
  Surface s;
  s.shape = &shape;
  s.position = p.position;
  s.uv = p.uv;
  s.barycentric = p.barycentric;
  s.primitive = p.primitive;
  return s;
}

/// The surface's position, moved off it to the side to which `direction` points.
inline Point3f offset_position(const Surface& s, const Vector3f& direction) {
  const float side = dot(s.ng, direction) < 0 ? -s.offset : s.offset;
  return s.position + Vector3f(s.ng) * side;
}

inline Ray spawn_ray(const Surface& s, const Vector3f& direction) {
  return {offset_position(s, direction), direction, INFINITY};
}

/// A ray whose parameter runs from 0 at the surface to just below 1 at `target`; `direction` is not
/// normalised. `target` has been moved off its own surface already.
inline Ray spawn_ray_to(const Surface& s, const Point3f& target) {
  const Point3f origin = offset_position(s, target - s.position);
  return {origin, target - origin, 0x1.fffep-1f};
}

/// Relative size of Surface::offset.
inline constexpr float kOffsetScale = 16 * 0x1p-23f;

}  // namespace duet
