// Affine transforms, built in double precision and applied in single.
#pragma once

#include <array>
#include <optional>

#include "math/vector.h"

namespace duet {

/// A 4×4 matrix in row-major order that acts on column vectors. Scene descriptions keep transforms
/// in this form, so that two ways to write the same transform can be compared.
struct Matrix4 {
  std::array<std::array<double, 4>, 4> m{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};

  bool operator==(const Matrix4&) const = default;
  Matrix4 operator*(const Matrix4& o) const;
  std::array<double, 4>& operator[](int i) { return m[i]; }
  const std::array<double, 4>& operator[](int i) const { return m[i]; }
  bool is_finite() const;
  /// True if single precision can hold all numbers.
  bool fits_floats() const;
  /// True if the last row is (0 0 0 1); its numbers may be off by `tolerance` in all.
  bool is_affine(double tolerance = 0) const;
  /// True if lengths and angles stay as they are, up to some digits of a file.
  bool is_rigid() const;
  /// Determinant of the upper left 3×3 block.
  double determinant3() const;
  /// Where it takes a direction or difference of points.
  std::array<double, 3> turned(const std::array<double, 3>& direction) const;
  /// Nothing if the matrix is singular (or so nearly that the inverse is not finite).
  std::optional<Matrix4> inverse() const;

  static Matrix4 translate(double x, double y, double z);
  static Matrix4 scale(double x, double y, double z);
  /// Rotation by `degrees` about an axis of any length; the identity for a zero axis.
  static Matrix4 rotate(double degrees, double x, double y, double z);
  /// Rodrigues' formula with the axis as it is: one of another length than one also stretches.
  static Matrix4 rotate_by_formula(double degrees, double x, double y, double z);
  /// Turns +z into the direction from `origin`, in some way around it; nothing for a zero
  /// direction.
  static std::optional<Matrix4> look_along(const std::array<double, 3>& origin,
                                           const std::array<double, 3>& direction);
  /// Camera to world: the camera at `origin` looks along +z at `target`, x to its left, y up
  /// (Mitsuba's convention). Nothing if the directions are degenerate.
  static std::optional<Matrix4> look_at(const std::array<double, 3>& origin,
                                        const std::array<double, 3>& target,
                                        const std::array<double, 3>& up);
};

/// An affine map with its inverse, in the precision of rendering.
class Transform {
 public:
  Transform() : Transform(Matrix4{}) {}
  /// `m` must be affine and invertible (the caller has checked it and can name the place).
  explicit Transform(const Matrix4& m);

  Point3f operator()(const Point3f& p) const { return apply_point(forward_, p); }
  Vector3f operator()(const Vector3f& v) const { return apply_vector(forward_, v); }
  /// Not normalised: the length changes with the scale.
  Normal3f operator()(const Normal3f& n) const { return apply_transposed(backward_, n); }
  Point3f inverse(const Point3f& p) const { return apply_point(backward_, p); }
  Vector3f inverse(const Vector3f& v) const { return apply_vector(backward_, v); }
  Normal3f inverse(const Normal3f& n) const { return apply_transposed(forward_, n); }

  /// True if the map turns right-handed bases into left-handed ones.
  bool mirrors() const { return mirrors_; }
  /// Row-major 3×4 block of the map.
  const std::array<std::array<float, 4>, 3>& rows() const { return forward_; }

 private:
  using Rows = std::array<std::array<float, 4>, 3>;
  static Point3f apply_point(const Rows& r, const Point3f& p) {
    return {r[0][0] * p.x + r[0][1] * p.y + r[0][2] * p.z + r[0][3],
            r[1][0] * p.x + r[1][1] * p.y + r[1][2] * p.z + r[1][3],
            r[2][0] * p.x + r[2][1] * p.y + r[2][2] * p.z + r[2][3]};
  }
  static Vector3f apply_vector(const Rows& r, const Vector3f& v) {
    return {r[0][0] * v.x + r[0][1] * v.y + r[0][2] * v.z,
            r[1][0] * v.x + r[1][1] * v.y + r[1][2] * v.z,
            r[2][0] * v.x + r[2][1] * v.y + r[2][2] * v.z};
  }
  static Normal3f apply_transposed(const Rows& r, const Normal3f& n) {
    return {r[0][0] * n.x + r[1][0] * n.y + r[2][0] * n.z,
            r[0][1] * n.x + r[1][1] * n.y + r[2][1] * n.z,
            r[0][2] * n.x + r[1][2] * n.y + r[2][2] * n.z};
  }

  Rows forward_, backward_;
  bool mirrors_ = false;
};

/// A 2×3 affine map of texture coordinates.
struct UvTransform {
  std::array<std::array<double, 3>, 2> m{{{1, 0, 0}, {0, 1, 0}}};
  bool operator==(const UvTransform&) const = default;
  Point2f operator()(const Point2f& p) const {
    return {static_cast<float>(m[0][0]) * p.x + static_cast<float>(m[0][1]) * p.y +
                static_cast<float>(m[0][2]),
            static_cast<float>(m[1][0]) * p.x + static_cast<float>(m[1][1]) * p.y +
                static_cast<float>(m[1][2])};
  }
};

}  // namespace duet
