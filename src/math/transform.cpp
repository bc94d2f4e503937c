#include "math/transform.h"

#include "math/angles.h"

namespace duet {

Matrix4 Matrix4::operator*(const Matrix4& o) const {
  Matrix4 r;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      r[i][j] = 0;
      for (int k = 0; k < 4; ++k) r[i][j] += m[i][k] * o[k][j];
    }
  return r;
}

bool Matrix4::is_finite() const {
  for (const auto& row : m)
    for (double v : row)
      if (!std::isfinite(v)) return false;
  return true;
}

bool Matrix4::fits_floats() const {
  for (const auto& row : m)
    for (double v : row)
      if (!std::isfinite(float(v))) return false;
  return true;
}

bool Matrix4::is_affine(double tolerance) const {
  const auto& [x, y, z, w] = m[3];
  return std::abs(x) + std::abs(y) + std::abs(z) + std::abs(w - 1) <= tolerance;
}

bool Matrix4::is_rigid() const {
  constexpr double tolerance = 1e-3;
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = i; j < 3; ++j) {
      const double product = m[i][0] * m[j][0] + m[i][1] * m[j][1] + m[i][2] * m[j][2];
      if (std::abs(product - (i == j ? 1 : 0)) > tolerance) return false;
    }
  return true;
}

double Matrix4::determinant3() const {
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

std::optional<Matrix4> Matrix4::inverse() const {
  // Gauss-Jordan elimination with partial pivoting.
  Matrix4 a = *this, r;
  for (int c = 0; c < 4; ++c) {
    int pivot = c;
    for (int i = c + 1; i < 4; ++i)
      if (std::abs(a[i][c]) > std::abs(a[pivot][c])) pivot = i;
    if (!(std::abs(a[pivot][c]) > 0)) return std::nullopt;
    std::swap(a[c], a[pivot]);
    std::swap(r[c], r[pivot]);
    const double s = 1 / a[c][c];
    for (int j = 0; j < 4; ++j) a[c][j] *= s, r[c][j] *= s;
    for (int i = 0; i < 4; ++i) {
      const double f = a[i][c];
      if (i == c || f == 0) continue;
      for (int j = 0; j < 4; ++j) a[i][j] -= f * a[c][j], r[i][j] -= f * r[c][j];
    }
  }
  if (!r.is_finite()) return std::nullopt;
  return r;
}

Matrix4 Matrix4::translate(double x, double y, double z) {
  Matrix4 r;
  r[0][3] = x, r[1][3] = y, r[2][3] = z;
  return r;
}

Matrix4 Matrix4::scale(double x, double y, double z) {
  Matrix4 r;
  r[0][0] = x, r[1][1] = y, r[2][2] = z;
  return r;
}

Matrix4 Matrix4::rotate(double degrees, double x, double y, double z) {
  const double l = std::sqrt(x * x + y * y + z * z);
  return l > 0 ? rotate_by_formula(degrees, x / l, y / l, z / l) : Matrix4{};
}

Matrix4 Matrix4::rotate_by_formula(double degrees, double x, double y, double z) {
  const double angle = degrees * kRadians;
  const double s = std::sin(angle), c = std::cos(angle), d = 1 - c;
  Matrix4 r;
  r[0] = {c + x * x * d, x * y * d - z * s, x * z * d + y * s, 0};
  r[1] = {x * y * d + z * s, c + y * y * d, y * z * d - x * s, 0};
  r[2] = {x * z * d - y * s, y * z * d + x * s, c + z * z * d, 0};
  return r;
}

std::array<double, 3> Matrix4::turned(const std::array<double, 3>& direction) const {
  std::array<double, 3> d{};
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) d[i] += m[i][j] * direction[j];
  return d;
}

std::optional<Matrix4> Matrix4::look_along(const std::array<double, 3>& origin,
                                           const std::array<double, 3>& direction) {
  const auto [x, y, z] = direction;
  const bool mostly_x = std::abs(x) > std::abs(y);
  return look_at(origin, {origin[0] + x, origin[1] + y, origin[2] + z},
                 mostly_x ? std::array<double, 3>{0, 1, 0} : std::array<double, 3>{1, 0, 0});
}

std::optional<Matrix4> Matrix4::look_at(const std::array<double, 3>& origin,
                                        const std::array<double, 3>& target,
                                        const std::array<double, 3>& up) {
  using V = std::array<double, 3>;
  const auto cross = [](const V& a, const V& b) {
    return V{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  const auto normalize = [](V& v) {
    const double l = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (double& c : v) c /= l;
    return l > 0 && std::isfinite(l);
  };
  V dir{target[0] - origin[0], target[1] - origin[1], target[2] - origin[2]};
  if (!normalize(dir)) return std::nullopt;
  V left = cross(up, dir);
  if (!normalize(left)) return std::nullopt;
  const V new_up = cross(dir, left);
  Matrix4 r;
  for (int i = 0; i < 3; ++i) r[i] = {left[i], new_up[i], dir[i], origin[i]};
  return r;
}

Transform::Transform(const Matrix4& matrix) {
  const Matrix4 inverse = matrix.inverse().value_or(Matrix4{});
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j) {
      forward_[i][j] = static_cast<float>(matrix[i][j]);
      backward_[i][j] = static_cast<float>(inverse[i][j]);
    }
  mirrors_ = matrix.determinant3() < 0;
}

}  // namespace duet
