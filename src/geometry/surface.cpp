#include "geometry/surface.h"

#include "math/warp.h"

namespace duet {

Surface make_analytic_surface(const Shape& shape, const Ray& ray, const Hit& hit);
Surface make_curve_surface(const Shape& shape, const Ray& ray, const Hit& hit);

namespace {

/// Barycentric interpolation with weights (1 − b1 − b2, b1, b2).
template <class T>
T interpolate(const T& a, const T& b, const T& c, float b1, float b2) {
  return a * (1 - b1 - b2) + b * b1 + c * b2;
}

struct Corners {
  const Point3f &p0, &p1, &p2;
  Vector3f e1, e2;
  Corners(const TriangleMesh& m, const std::array<uint32_t, 3>& t)
      : p0(m.positions[t[0]]),
        p1(m.positions[t[1]]),
        p2(m.positions[t[2]]),
        e1(p1 - p0),
        e2(p2 - p0) {}
  float rounding_offset() const {
    return kOffsetScale * std::max(std::max(max_abs(p0), max_abs(p1)), max_abs(p2));
  }
  /// Not normalised.
  Normal3f normal() const { return Normal3f(cross(e1, e2)); }
};

/// Derivatives of the position by the texture coordinates (without any, by the barycentric ones);
/// false if they do not exist.
bool tangents(const TriangleMesh& m, const std::array<uint32_t, 3>& t, const Corners& c,
              Surface& s) {
  s.dp_du = c.e1;
  s.dp_dv = c.e2;
  if (m.uvs.empty()) return true;
  const Point2f a = m.uvs[t[1]] - m.uvs[t[0]], b = m.uvs[t[2]] - m.uvs[t[0]];
  const float det = a.x * b.y - a.y * b.x;
  const float inv = 1 / det;
  if (det == 0 || !std::isfinite(inv)) return false;
  s.dp_du = (c.e1 * b.y - c.e2 * a.y) * inv;
  s.dp_dv = (c.e2 * a.x - c.e1 * b.x) * inv;
  return true;
}

}  // namespace

Surface make_mesh_surface(const Shape& shape, const Hit& hit) {
  const TriangleMesh& m = *shape.mesh;
  const std::array<uint32_t, 3>& t = m.triangles[hit.primitive];
  const Corners c(m, t);
  const float sign = shape.flip_normals ? -1.0f : 1.0f;
  Surface s;
  s.shape = &shape;
  s.primitive = hit.primitive;
  s.barycentric = {hit.u, hit.v};
  s.position = c.p0 + (c.e1 * hit.u + c.e2 * hit.v);
  s.offset = c.rounding_offset();
  const Normal3f n = c.normal();
  s.ng = n * (sign / std::sqrt(length_squared(n)));
  Normal3f ns = s.ng;
  if (!m.normals.empty()) {
    const Normal3f smooth =
        interpolate(m.normals[t[0]], m.normals[t[1]], m.normals[t[2]], hit.u, hit.v);
    const float l2 = length_squared(smooth);
    if (l2 > 0) {
      ns = smooth * (sign / std::sqrt(l2));
      if (dot(s.ng, ns) < 0) s.ng = -s.ng;
    }
  }
  if (shape.needs.uv)
    s.uv = m.uvs.empty() ? s.barycentric
                         : interpolate(m.uvs[t[0]], m.uvs[t[1]], m.uvs[t[2]], hit.u, hit.v);
  if (!shape.needs.tangents) {
    s.shading = Frame(ns);
    return s;
  }
  if (!tangents(m, t, c, s)) coordinate_system(s.ng, s.dp_du, s.dp_dv);
  s.shading = Frame::from_tangent(ns, s.dp_du);
  return s;
}

namespace {

/// In the space in which the shape stands.
Surface make_own_surface(const Shape& shape, const Ray& ray, const Hit& hit) {
  switch (shape.kind) {
    case ShapeKind::mesh:
      return make_mesh_surface(shape, hit);
    case ShapeKind::curves:
      return make_curve_surface(shape, ray, hit);
    default:
      return make_analytic_surface(shape, ray, hit);
  }
}

}  // namespace

Surface make_surface(const Shape& shape, const Instance* instance, const Ray& ray, const Hit& hit) {
  if (!instance) return make_own_surface(shape, ray, hit);
  const Transform& place = instance->to_world;
  Surface s = make_own_surface(
      shape, {place.inverse(ray.origin), place.inverse(ray.direction), ray.tmax}, hit);
  const float local = s.offset;
  s.position = place(s.position);
  // The rounding errors of the copy, those of placing it, and those of bringing rays to it.
  s.offset = 2 * (instance->scale * local + kOffsetScale * max_abs(s.position));
  s.ng = normalize(place(s.ng));
  const Normal3f ns = normalize(place(s.shading.n));
  if (shape.needs.tangents) {
    s.dp_du = place(s.dp_du);
    s.dp_dv = place(s.dp_dv);
    s.shading = Frame::from_tangent(ns, s.dp_du);
  } else {
    s.shading = Frame(ns);
  }
  return s;
}

float triangle_area(const TriangleMesh& mesh, uint32_t primitive) {
  return 0.5f * length(Corners(mesh, mesh.triangles[primitive]).normal());
}

ShapePoint point_on_triangle(const Shape& shape, uint32_t primitive, const Point2f& barycentric) {
  Hit hit;
  hit.primitive = primitive;
  hit.u = barycentric.x, hit.v = barycentric.y;
  const Surface s = make_mesh_surface(shape, hit);
  ShapePoint p;
  p.position = s.position;
  p.ng = s.ng;
  p.ns = s.shading.n;
  p.uv = s.uv;
  p.offset = s.offset;
  p.pdf = PdfA{1 / triangle_area(*shape.mesh, primitive)};
  p.barycentric = barycentric;
  p.primitive = primitive;
  return p;
}

ShapePoint sample_triangle(const Shape& shape, uint32_t primitive, const Point2f& u) {
  return point_on_triangle(shape, primitive, square_to_triangle(u));
}

}  // namespace duet
