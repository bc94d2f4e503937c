// An orthonormal basis (s, t, n), usually around a shading normal.
#pragma once

#include "math/vector.h"

namespace duet {

/// Two unit vectors that complete `n` (unit length) to a right-handed basis.
/// Source: Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017. Mitsuba uses
/// the same construction where texture coordinates are degenerate, so anisotropic BSDFs agree.
[[gnu::always_inline]] inline void coordinate_system(const Normal3f& n, Vector3f& s, Vector3f& t) {
  const float sign = std::copysign(1.0f, n.z);
  const float a = -1.0f / (sign + n.z);
  const float b = n.x * n.y * a;
  s = {1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x};
  t = {b, sign + n.y * n.y * a, -n.y};
}

struct Frame {
  Vector3f s, t;
  Normal3f n;

  Frame() = default;
  Frame(const Vector3f& s_, const Vector3f& t_, const Normal3f& n_) : s(s_), t(t_), n(n_) {}
  [[gnu::always_inline]] explicit Frame(const Normal3f& n_) : n(n_) { coordinate_system(n, s, t); }

  /// The frame around `n` whose s points along the part of `dp_du` that is perpendicular to n; the
  /// canonical frame if there is none.
  static Frame from_tangent(const Normal3f& n, const Vector3f& dp_du) {
    const Vector3f s = dp_du - Vector3f(n) * dot(n, dp_du);
    const float l2 = length_squared(s);
    if (!(l2 > 0)) return Frame(n);
    const Vector3f u = s * (1.0f / std::sqrt(l2));
    return {u, cross(n, u), n};
  }

  [[gnu::always_inline]] Vector3f to_local(const Vector3f& v) const {
    return {dot(s, v), dot(t, v), dot(n, v)};
  }
  [[gnu::always_inline]] Vector3f to_world(const Vector3f& v) const {
    return s * v.x + t * v.y + Vector3f(n) * v.z;
  }
};

/// Trigonometry of a direction in its local frame, where the normal is the z axis.
inline float cos_theta(const Vector3f& w) {
  return w.z;
}
inline float abs_cos_theta(const Vector3f& w) {
  return std::abs(w.z);
}
inline float sin2_theta(const Vector3f& w) {
  return std::max(0.0f, 1.0f - w.z * w.z);
}
inline bool same_hemisphere(const Vector3f& a, const Vector3f& b) {
  return a.z * b.z > 0;
}
/// `w`, or its mirror image behind the surface: so that both sides can be treated as if seen from
/// above.
[[gnu::always_inline]] inline Vector3f mirrored(const Vector3f& w, bool mirror) {
  return {w.x, w.y, mirror ? -w.z : w.z};
}
/// The mirror image of `w` about the normal.
inline Vector3f reflect(const Vector3f& w) {
  return {-w.x, -w.y, w.z};
}
/// The mirror image of `w` about the unit direction `m`.
inline Vector3f reflect(const Vector3f& w, const Vector3f& m) {
  return m * (2 * dot(w, m)) - w;
}

}  // namespace duet
