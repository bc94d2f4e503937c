#include "geometry/curves.h"

#include "geometry/surface.h"

namespace duet {

void transform_curves(CurveSet& curves, const Matrix4& m) {
  for (TubePoint& p : curves.points) {
    const double x = p.position.x, y = p.position.y, z = p.position.z;
    for (int i = 0; i < 3; ++i)
      p.position[i] = float(m[i][0] * x + m[i][1] * y + m[i][2] * z + m[i][3]);
  }
}

CurveCenter curve_center(const CurveSet& curves, uint32_t segment, float u) {
  const TubePoint* const p = &curves.points[curves.segments[segment]];
  CurveCenter c;
  if (curves.kind == CurveKind::linear) {
    c.first = p[1].position - p[0].position;
    c.second = Vector3f(0);
    c.position = p[0].position + c.first * u;
    c.radius_slope = p[1].radius - p[0].radius;
    c.radius = p[0].radius + c.radius_slope * u;
    return c;
  }
  // The uniform cubic B-spline in terms of differences: these keep their digits far from the
  // origin.
  const Vector3f a = p[1].position - p[0].position, b = p[2].position - p[1].position,
                 d = p[3].position - p[2].position;
  const float ra = p[1].radius - p[0].radius, rb = p[2].radius - p[1].radius,
              rd = p[3].radius - p[2].radius;
  const float v = 1 - u;
  // Weights of the differences in the position: sums of the basis functions to their right.
  const float wa = 1 - v * v * v / 6, wd = u * u * u / 6,
              wb = (1 + 3 * u + 3 * u * u - 2 * u * u * u) / 6;
  const float sa = v * v / 2, sb = 0.5f + u * v, sd = u * u / 2;
  c.position = p[0].position + (a * wa + b * wb + d * wd);
  c.radius = p[0].radius + (ra * wa + rb * wb + rd * wd);
  c.first = a * sa + b * sb + d * sd;
  c.radius_slope = ra * sa + rb * sb + rd * sd;
  c.second = (b - a) * v + (d - b) * u;
  return c;
}

namespace {

/// Two unit vectors across the unit vector `axis`, such that the angle from the second one to the
/// first is where Mitsuba's texture coordinates begin.
void around(const Vector3f& axis, Vector3f& up, Vector3f& side) {
  const Vector3f z = Vector3f(0, 0, 1) - axis * axis.z;
  const float l2 = length_squared(z);
  up = l2 > 1e-12f ? z * (1 / std::sqrt(l2)) : Vector3f(0, 1, 0);
  side = cross(up, axis);
}

/// The derivative of the surface point by the segment's parameter, at the same angle from `side`:
/// the centre moves on, the radius grows, a bend turns the cross-section, and `side` turns around
/// the axis, because it stays across z.
Vector3f along_v(const CurveCenter& c, const Vector3f& axis, const Vector3f& side,
                 const Vector3f& outwards, const Vector3f& sideways) {
  const float speed = length(c.first);
  if (!(speed > 0)) return outwards * c.radius_slope;
  const float bend = dot(outwards, c.second) / speed;
  const float across_z = 1 - axis.z * axis.z;
  const float twist =
      across_z > 1e-12f ? axis.z * dot(side, c.second) / (speed * std::sqrt(across_z)) : 0.0f;
  return c.first + outwards * c.radius_slope + (sideways * twist - axis * bend) * c.radius;
}

/// A point of a ribbon. Its texture coordinates go along the curve and across it.
Surface make_ribbon_surface(const Shape& shape, const Ray& ray, const Hit& hit) {
  const CurveSet& curves = *shape.curves;
  const CurveCenter c = curve_center(curves, hit.primitive, hit.u);
  Surface s;
  s.shape = &shape;
  s.primitive = hit.primitive;
  s.barycentric = {hit.u, 0};
  s.position = ray.origin + ray.direction * hit.t;
  const Vector3f axis(normalized_or_zero(Normal3f(c.first)));
  Vector3f across = cross(ray.direction, axis);
  if (!(length_squared(across) > 1e-12f)) across = Frame(Normal3f(ray.direction)).s;
  across = normalize(across);
  const Vector3f facing = cross(across, axis);
  // How far from the middle, which in a bend need not be straight across from it.
  const Vector3f from_middle = s.position - c.position;
  const float offset = std::copysign(length(from_middle), dot(from_middle, across));
  const float share =
      c.radius > 0 ? 0.5f + 0.5f * std::clamp(offset / c.radius, -1.0f, 1.0f) : 0.5f;
  Vector3f normal = facing, side = across;
  if (curves.profile == CurveProfile::round_ribbon) {
    const float angle = kPi * (share - 0.5f);
    // As in pbrt: it turns towards the middle, as that of a gutter does.
    normal = facing * std::cos(angle) - across * std::sin(angle);
    side = across * std::cos(angle) + facing * std::sin(angle);
  }
  const Normal3f n(normal);
  s.ng = n;
  // Other rays see another ribbon: they start where they are clear of all of them, as in pbrt.
  s.offset = 2 * c.radius * (std::abs(n.x) + std::abs(n.y) + std::abs(n.z)) +
             kOffsetScale * max_abs(s.position);
  const float segments = float(curves.segments.size());
  s.uv = {(hit.u + float(hit.primitive)) / segments, share};
  s.dp_du = c.first * segments;
  s.dp_dv = side * (2 * c.radius);
  s.shading = length_squared(axis) > 0 ? Frame::from_tangent(n, axis) : Frame(n);
  return s;
}

}  // namespace

Surface make_curve_surface(const Shape& shape, const Ray& ray, const Hit& hit) {
  const CurveSet& curves = *shape.curves;
  if (curves.profile != CurveProfile::tube) return make_ribbon_surface(shape, ray, hit);
  const CurveCenter c = curve_center(curves, hit.primitive, hit.u);
  Surface s;
  s.shape = &shape;
  s.primitive = hit.primitive;
  s.barycentric = {hit.u, 0};
  const Point3f found = ray.origin + ray.direction * hit.t;
  const Vector3f from_center = found - c.position;
  const float distance = length(from_center);
  const float length_of_first = length(c.first);
  const Vector3f axis = length_of_first > 0 ? c.first * (1 / length_of_first) : Vector3f(0, 0, 1);
  Vector3f up, side;
  around(axis, up, side);
  const Vector3f outwards = distance > 0 ? from_center * (1 / distance) : side;
  // Back onto the surface, to remove the rounding error of the distance.
  s.position = c.position + outwards * c.radius;
  const Vector3f radius_vector = outwards * c.radius;
  Normal3f n(outwards);
  if (curves.kind == CurveKind::bspline) {
    // The surface point moves with the centre and with the radius, and a bend brings the tubes'
    // cross-sections closer together on its inside.
    const Vector3f gradient =
        radius_vector * (length_squared(c.first) - dot(radius_vector, c.second)) -
        c.first * (c.radius_slope * c.radius);
    const float l2 = length_squared(gradient);
    if (l2 > 0) n = Normal3f(gradient * (1 / std::sqrt(l2)));
  }
  s.ng = n;
  // Rays from within do not see the tube: leaving it needs no care, entering it only as much as its
  // intersections are uncertain.
  s.offset = kOffsetScale * max_abs(s.position) + 1e-3f * c.radius;
  if (shape.needs.uv) {
    const float angle = std::atan2(dot(up, outwards), dot(side, outwards)) * (0.5f * kInvPi);
    s.uv = {angle < 0 ? angle + 1 : angle,
            (hit.u + float(hit.primitive)) / float(curves.segments.size())};
  }
  if (!shape.needs.tangents) {
    s.shading = Frame(n);
    return s;
  }
  if (curves.kind == CurveKind::linear) {
    // Mitsuba gives linear curves no tangents.
    s.shading = Frame(n);
    s.dp_du = s.shading.s, s.dp_dv = s.shading.t;
    return s;
  }
  const Vector3f sideways = cross(axis, outwards);
  s.dp_du = sideways * (2 * kPi * c.radius);
  s.dp_dv = along_v(c, axis, side, outwards, sideways) * float(curves.segments.size());
  s.shading = Frame::from_tangent(n, s.dp_du);
  return s;
}

Bounds curve_bounds(const CurveSet& curves) {
  Bounds b;
  for (const TubePoint& p : curves.points) {
    b.extend(p.position - Vector3f(p.radius));
    b.extend(p.position + Vector3f(p.radius));
  }
  return b;
}

}  // namespace duet
