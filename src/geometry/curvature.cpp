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

/// x = M q, where q is on the unit sphere or the unit cylinder around z: a curve on it has
/// q'' · q = −|q'|² (on the cylinder without the part along z), so that with the world's normal n
/// the second fundamental form of x is −(n · M q) times that.
Curvature of_quadric(const Shape& shape, const Point2f& uv) {
  const bool sphere = shape.kind == ShapeKind::sphere;
  const float phi = 2 * kPi * uv.x, theta = sphere ? kPi * uv.y : 0.5f * kPi;
  const float sin_phi = std::sin(phi), cos_phi = std::cos(phi);
  const float sin_theta = std::sin(theta), cos_theta = std::cos(theta);
  const Vector3f q(cos_phi * sin_theta, sin_phi * sin_theta, sphere ? cos_theta : 0.0f);
  // Unit vectors across q: around the axis, and along a meridian or the axis.
  const Vector3f around(-sin_phi, cos_phi, 0);
  const Vector3f along =
      sphere ? Vector3f(cos_phi * cos_theta, sin_phi * cos_theta, -sin_theta) : Vector3f(0, 0, 1);
  const Form first = metric(shape.to_world(around), shape.to_world(along));
  const Normal3f n = normalize(shape.to_world(Normal3f(q)));
  const float height = dot(n, shape.to_world(q)), sign = faces_inwards(shape) ? -1.0f : 1.0f;
  const Form second{-height, 0, sphere ? -height : 0.0f};
  return {sign * half_trace(first, second), second.determinant() / first.determinant()};
}

}  // namespace

Curvature curvature_at(const Surface& s) {
  const Shape& shape = *s.shape;
  if (shape.mesh) return of_triangle(*shape.mesh, s.primitive, s.barycentric, shape.flip_normals);
  if (shape.kind == ShapeKind::disk) return {};
  return of_quadric(shape, s.uv);
}

}  // namespace duet
