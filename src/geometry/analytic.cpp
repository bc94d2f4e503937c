#include <algorithm>

#include "geometry/quadric.h"
#include "geometry/surface.h"
#include "math/warp.h"

namespace duet {

double analytic_distance(const Shape& shape, uint32_t part, const Ray& ray, double tnear) {
  const LocalVector o = to_local(shape.to_local, ray.origin);
  const LocalVector d = to_local(shape.to_local, ray.direction);
  const double tfar = double(ray.tmax);
  switch (shape.kind) {
    case ShapeKind::sphere:
      return quadric_distance<ShapeKind::sphere>(o, d, tnear, tfar);
    case ShapeKind::cylinder:
      return quadric_distance<ShapeKind::cylinder>(o, d, tnear, tfar);
    case ShapeKind::disk:
      return quadric_distance<ShapeKind::disk>(o, d, tnear, tfar);
    case ShapeKind::sdf_grid:
      return intersect_cell(*shape.sdf, shape.sdf->cells[part], {o.x, o.y, o.z}, {d.x, d.y, d.z},
                            tnear, tfar)
          .value_or(double(INFINITY));
    case ShapeKind::mesh:
    case ShapeKind::curves:
      break;
  }
  return double(INFINITY);
}

void Bounds::extend(const Point3f& p) {
  lower = {std::min(lower.x, p.x), std::min(lower.y, p.y), std::min(lower.z, p.z)};
  upper = {std::max(upper.x, p.x), std::max(upper.y, p.y), std::max(upper.z, p.z)};
}

namespace {

Bounds placed_box(const Shape& shape, const Point3f& lower, const Point3f& upper) {
  Bounds b;
  for (int i = 0; i < 8; ++i)
    b.extend(shape.to_world(
        Point3f(i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y, i & 4 ? upper.z : lower.z)));
  // The box of a box is larger than that of the shape, but never smaller: pad for rounding only.
  const float pad = kOffsetScale * std::max(max_abs(b.lower), max_abs(b.upper));
  b.lower = b.lower - Vector3f(pad), b.upper = b.upper + Vector3f(pad);
  return b;
}

}  // namespace

Bounds analytic_bounds(const Shape& shape) {
  if (shape.kind == ShapeKind::sdf_grid) return placed_box(shape, Point3f(0), Point3f(1));
  return placed_box(shape, {-1, -1, shape.kind == ShapeKind::sphere ? -1.0f : 0.0f},
                    {1, 1, shape.kind == ShapeKind::disk ? 0.0f : 1.0f});
}

Bounds analytic_bounds(const Shape& shape, uint32_t part) {
  if (shape.kind != ShapeKind::sdf_grid) return analytic_bounds(shape);
  Point3f lower, upper;
  cell_bounds(*shape.sdf, shape.sdf->cells[part], lower, upper);
  return placed_box(shape, lower, upper);
}

bool faces_inwards(const Shape& s) {
  return s.flip_normals != (s.kind == ShapeKind::sphere && s.to_world.mirrors());
}

float area_stretch(const Shape& shape, const Normal3f& local_normal) {
  // |det M| |M^-T n|, the general law for how an affine map stretches oriented areas.
  const auto& r = shape.to_world.rows();
  const Vector3f x(r[0][0], r[1][0], r[2][0]), y(r[0][1], r[1][1], r[2][1]),
      z(r[0][2], r[1][2], r[2][2]);
  return std::abs(dot(x, cross(y, z))) * length(shape.to_world(local_normal));
}

namespace {

/// Area of the unit shape.
float local_area(ShapeKind kind) {
  return kind == ShapeKind::sphere ? 4 * kPi : kind == ShapeKind::disk ? kPi : 2 * kPi;
}

/// Position and normal of the point of the unit shape with these uniform parameters.
void unit_point(ShapeKind kind, const Point2f& u, Point3f& p, Normal3f& n) {
  switch (kind) {
    case ShapeKind::sphere: {
      n = Normal3f(square_to_sphere(u));
      p = Point3f(n);
      break;
    }
    case ShapeKind::disk: {
      const Point2f d = square_to_disk(u);
      p = {d.x, d.y, 0};
      n = {0, 0, 1};
      break;
    }
    default: {
      const float phi = 2 * kPi * u.x;
      n = {std::cos(phi), std::sin(phi), 0};
      p = {n.x, n.y, u.y};
    }
  }
}

Normal3f world_normal(const Shape& shape, const Normal3f& local) {
  const Normal3f n = normalize(shape.to_world(local));
  return faces_inwards(shape) ? -n : n;
}

float rounding_offset(const Shape& shape, const Point3f& p) {
  const auto& r = shape.to_world.rows();
  float extent = max_abs(p);
  for (const auto& row : r)
    extent =
        std::max(extent, std::abs(row[3]) + std::abs(row[0]) + std::abs(row[1]) + std::abs(row[2]));
  return kOffsetScale * extent;
}

}  // namespace

PdfA pdf_analytic(const Shape& shape, const Normal3f& local_normal) {
  return {1 / (local_area(shape.kind) * area_stretch(shape, local_normal))};
}

Point2f analytic_uv(ShapeKind kind, const Point3f& p) {
  const float phi = std::atan2(p.y, p.x);
  const float around = (phi < 0 ? phi + 2 * kPi : phi) * (0.5f * kInvPi);
  switch (kind) {
    case ShapeKind::sphere:
      return {around, std::acos(std::clamp(p.z, -1.0f, 1.0f)) * kInvPi};
    case ShapeKind::disk:
      return {std::sqrt(p.x * p.x + p.y * p.y), around};
    default:
      return {around, p.z};
  }
}

ShapePoint sample_analytic(const Shape& shape, const Point2f& u) {
  Point3f p;
  Normal3f n;
  unit_point(shape.kind, u, p, n);
  ShapePoint s;
  s.position = shape.to_world(p);
  s.ng = s.ns = world_normal(shape, n);
  s.pdf = pdf_analytic(shape, n);
  s.offset = rounding_offset(shape, s.position);
  s.uv = analytic_uv(shape.kind, p);
  return s;
}

double surface_area(const Shape& shape) {
  if (shape.kind == ShapeKind::mesh) {
    double area = 0;
    for (uint32_t i = 0; i < shape.mesh->triangles.size(); ++i)
      area += triangle_area(*shape.mesh, i);
    return area;
  }
  // The midpoint rule over the parameters: exact for unstretched shapes.
  constexpr int kSteps = 64;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      Point3f p;
      Normal3f n;
      unit_point(shape.kind, {(float(i) + 0.5f) / kSteps, (float(j) + 0.5f) / kSteps}, p, n);
      sum += area_stretch(shape, n);
    }
  return sum / (kSteps * kSteps) * local_area(shape.kind);
}

namespace {

/// A point of a signed distance field, near p.
Surface make_sdf_surface(const Shape& shape, uint32_t primitive, const LocalVector& p) {
  const SdfPoint at = surface_point(*shape.sdf, shape.sdf->cells[primitive], {p.x, p.y, p.z});
  Surface s;
  s.shape = &shape;
  s.primitive = primitive;
  s.position = shape.to_world(at.position);
  s.ng = world_normal(shape, at.geometric);
  s.offset = rounding_offset(shape, s.position);
  const Normal3f ns = world_normal(shape, at.shading);
  if (dot(s.ng, ns) < 0) s.ng = -s.ng;
  s.uv = {0, 0};
  s.shading = Frame(ns);
  s.dp_du = s.shading.s, s.dp_dv = s.shading.t;
  return s;
}

/// A point near a unit shape back onto it, which removes the rounding error of its distance, and
/// the normal there.
Normal3f snap_to_shape(ShapeKind kind, LocalVector& p) {
  switch (kind) {
    case ShapeKind::sphere: {
      const double l = 1 / std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
      p.x *= l, p.y *= l, p.z *= l;
      return {float(p.x), float(p.y), float(p.z)};
    }
    case ShapeKind::cylinder: {
      const double l = 1 / std::sqrt(p.x * p.x + p.y * p.y);
      p.x *= l, p.y *= l;
      return {float(p.x), float(p.y), 0};
    }
    default:
      p.z = 0;
      return {0, 0, 1};
  }
}

/// The derivatives of the position by u and v, on the unit shape.
std::pair<Vector3f, Vector3f> derivatives(ShapeKind kind, const Point3f& p) {
  const float r = std::sqrt(p.x * p.x + p.y * p.y);
  const float cos_phi = r > 0 ? p.x / r : 1.0f, sin_phi = r > 0 ? p.y / r : 0.0f;
  const Vector3f tangent(-2 * kPi * p.y, 2 * kPi * p.x, 0);
  switch (kind) {
    case ShapeKind::sphere:
      return {tangent, Vector3f(p.z * cos_phi, p.z * sin_phi, -r) * kPi};
    case ShapeKind::disk:
      return {Vector3f(cos_phi, sin_phi, 0), r > 0 ? tangent : Vector3f(0, 1, 0)};
    default:
      return {tangent, Vector3f(0, 0, 1)};
  }
}

}  // namespace

Surface make_analytic_surface(const Shape& shape, const Ray& ray, const Hit& hit) {
  const LocalVector o = to_local(shape.to_local, ray.origin);
  const LocalVector d = to_local(shape.to_local, ray.direction);
  LocalVector at{o.x + hit.t * d.x, o.y + hit.t * d.y, o.z + hit.t * d.z};
  if (shape.kind == ShapeKind::sdf_grid) return make_sdf_surface(shape, hit.primitive, at);
  Surface s;
  s.shape = &shape;
  s.primitive = hit.primitive;
  const Normal3f n = snap_to_shape(shape.kind, at);
  const Point3f p{float(at.x), float(at.y), float(at.z)};
  s.position = shape.to_world(p);
  s.ng = world_normal(shape, n);
  s.offset = rounding_offset(shape, s.position);
  if (!shape.needs.uv && !shape.needs.tangents) {
    s.shading = Frame(s.ng);
    return s;
  }
  s.uv = analytic_uv(shape.kind, p);
  const auto [du, dv] = derivatives(shape.kind, p);
  s.dp_du = shape.to_world(du);
  s.dp_dv = shape.to_world(dv);
  s.shading = Frame::from_tangent(s.ng, s.dp_du);
  return s;
}

}  // namespace duet
