#include "geometry/curvature.h"

namespace duet {

namespace {

/// A symmetric form on the two vectors that span a tangent plane.
struct Form {
  float uu, uv, vv;
  float determinant() const { return uu * vv - uv * uv; }
};

Form metric(const Vector3f& u, const Vector3f& v) {
  return {length_squared(u), dot(u, v), length_squared(v)};
}

/// Half the trace of first⁻¹ second.
float half_trace(const Form& first, const Form& second) {
  return 0.5f * (second.uu * first.vv - 2 * second.uv * first.uv + second.vv * first.uu) /
         first.determinant();
}

Curvature of_triangle(const TriangleMesh& m, uint32_t primitive, const Point2f& b, bool flip) {
  if (m.normals.empty()) return {};
  const auto& t = m.triangles[primitive];
  const Vector3f e1 = m.positions[t[1]] - m.positions[t[0]],
                 e2 = m.positions[t[2]] - m.positions[t[0]];
  const Vector3f n0(m.normals[t[0]]), n1(m.normals[t[1]]), n2(m.normals[t[2]]);
  const Vector3f sum = n0 + (n1 - n0) * b.x + (n2 - n0) * b.y;
  const float l = length(sum);
  const Form first = metric(e1, e2);
  if (!(l > 0) || !(first.determinant() > 0)) return {};
  const Vector3f n = sum * ((flip ? -1.0f : 1.0f) / l);
  // The derivatives of the unit normal along both edges.
  const auto turn = [&](const Vector3f& d) {
    const Vector3f change = d * ((flip ? -1.0f : 1.0f) / l);
    return change - n * dot(n, change);
  };
  const Vector3f d1 = turn(n1 - n0), d2 = turn(n2 - n0);
  // Normals that no surface has can make the form uneven: the trace takes the mean.
  const float c12 = -dot(e2, d1), c21 = -dot(e1, d2);
  const Form second{-dot(e1, d1), 0.5f * (c12 + c21), -dot(e2, d2)};
  return {half_trace(first, second), (second.uu * second.vv - c12 * c21) / first.determinant()};
}

/// A point of the unit sphere or of the unit cylinder around z.
struct QuadricPoint {
  Vector3f q;
  Vector3f around,
      along;  ///< unit vectors across it: around the axis; along a meridian or the axis
};

QuadricPoint quadric_point(ShapeKind kind, const Point2f& uv) {
  const bool sphere = kind == ShapeKind::sphere;
  const float phi = 2 * kPi * uv.x, theta = sphere ? kPi * uv.y : 0.5f * kPi;
  const float sin_phi = std::sin(phi), cos_phi = std::cos(phi);
  const float sin_theta = std::sin(theta), cos_theta = std::cos(theta);
  return {
      {cos_phi * sin_theta, sin_phi * sin_theta, sphere ? cos_theta : 0.0f},
      {-sin_phi, cos_phi, 0},
      sphere ? Vector3f(cos_phi * cos_theta, sin_phi * cos_theta, -sin_theta) : Vector3f(0, 0, 1)};
}

/// x = M q, where q is on the unit sphere or the unit cylinder around z: a curve on it has
/// q'' · q = −|q'|² (on the cylinder without the part along z), so that with the world's normal n
/// the second fundamental form of x is −(n · M q) times that.
Curvature of_quadric(const Shape& shape, const Point2f& uv) {
  const bool sphere = shape.kind == ShapeKind::sphere;
  const auto [q, around, along] = quadric_point(shape.kind, uv);
  const Form first = metric(shape.to_world(around), shape.to_world(along));
  const Normal3f n = normalize(shape.to_world(Normal3f(q)));
  const float height = dot(n, shape.to_world(q)), sign = faces_inwards(shape) ? -1.0f : 1.0f;
  const Form second{-height, 0, sphere ? -height : 0.0f};
  return {sign * half_trace(first, second), second.determinant() / first.determinant()};
}

/// Derivatives in the space in which the shape stands, and the tangents and normal there.
struct Turning {
  Vector3f dp_du, dp_dv, n;
  NormalDerivatives dn;
};

/// By the texture coordinates, or by the barycentric ones where there are none.
Turning turning_of_triangle(const TriangleMesh& m, uint32_t primitive, const Point2f& b,
                            bool flip) {
  const auto& t = m.triangles[primitive];
  const Vector3f e1 = m.positions[t[1]] - m.positions[t[0]],
                 e2 = m.positions[t[2]] - m.positions[t[0]];
  const float sign = flip ? -1.0f : 1.0f;
  const Vector3f n0(m.normals[t[0]]);
  const Vector3f d1 = (Vector3f(m.normals[t[1]]) - n0) * sign,
                 d2 = (Vector3f(m.normals[t[2]]) - n0) * sign;
  const Vector3f n(normalized_or_zero(Normal3f(n0 * sign + d1 * b.x + d2 * b.y)));
  if (m.uvs.empty()) return {e1, e2, n, {d1, d2}};
  const Point2f p = m.uvs[t[1]] - m.uvs[t[0]], q = m.uvs[t[2]] - m.uvs[t[0]];
  const float inverse = 1 / (p.x * q.y - p.y * q.x);
  if (!std::isfinite(inverse)) return {e1, e2, n, {}};
  const auto by_u = [&](const Vector3f& a, const Vector3f& c) {
    return (a * q.y - c * p.y) * inverse;
  };
  const auto by_v = [&](const Vector3f& a, const Vector3f& c) {
    return (c * p.x - a * q.x) * inverse;
  };
  return {by_u(e1, e2), by_v(e1, e2), n, {by_u(d1, d2), by_v(d1, d2)}};
}

/// On x = M q as above the normal has the direction M⁻ᵀ q.
Turning turning_of_quadric(const Shape& shape, const Point2f& uv) {
  const bool sphere = shape.kind == ShapeKind::sphere;
  const QuadricPoint p = quadric_point(shape.kind, uv);
  const Vector3f q = p.q, around = Vector3f(-q.y, q.x, 0) * (2 * kPi);
  const Vector3f along = sphere ? p.along * kPi : p.along;
  const Vector3f direction(shape.to_world(Normal3f(q)));
  const float inverse = (faces_inwards(shape) ? -1.0f : 1.0f) / length(direction);
  const Vector3f n = direction * inverse;
  const auto turn = [&](const Vector3f& dq) {
    const Vector3f change = Vector3f(shape.to_world(Normal3f(dq))) * inverse;
    return change - n * dot(n, change);
  };
  return {shape.to_world(around),
          shape.to_world(along),
          n,
          {turn(around), sphere ? turn(along) : Vector3f(0)}};
}

}  // namespace

Curvature curvature_at(const Surface& s) {
  const Shape& shape = *s.shape;
  if (shape.mesh) return of_triangle(*shape.mesh, s.primitive, s.barycentric, shape.flip_normals);
  if (shape.kind == ShapeKind::disk) return {};
  return of_quadric(shape, s.uv);
}

NormalDerivatives normal_derivatives(const Surface& s) {
  const Shape& shape = *s.shape;
  if (!has_curvature(shape.kind) || shape.kind == ShapeKind::disk) return {};
  if (shape.mesh && shape.mesh->normals.empty()) return {};
  const Turning own =
      shape.mesh ? turning_of_triangle(*shape.mesh, s.primitive, s.barycentric, shape.flip_normals)
                 : turning_of_quadric(shape, s.uv);
  // Instances turn and scale all of it: what is along the tangents stays along them.
  const Form first = metric(own.dp_du, own.dp_dv);
  const float size = std::sqrt(first.determinant());
  const float grown = length(cross(s.dp_du, s.dp_dv)) / size;
  if (!(size > 0) || !(grown > 0)) return {};
  const auto place = [&](const Vector3f& d) {
    const float x = dot(d, own.dp_du), y = dot(d, own.dp_dv);
    const float inverse = 1 / (first.determinant() * std::sqrt(grown));
    return (s.dp_du * (first.vv * x - first.uv * y) + s.dp_dv * (first.uu * y - first.uv * x)) *
               inverse +
           Vector3f(s.shading.n) * dot(d, own.n);
  };
  return {place(own.dn.du), place(own.dn.dv)};
}

}  // namespace duet
