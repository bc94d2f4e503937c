// From a point of the scene back to the film.
#pragma once

#include "math/vector.h"

namespace duet {

/// Three directions by which film positions become rays: by one pixel to the right, by one down,
/// and along the axis of the view. They need not be orthogonal.
class FilmAxes {
 public:
  FilmAxes() = default;
  FilmAxes(const Vector3f& right, const Vector3f& down, const Vector3f& forward) {
    // In double precision, because pixels are small.
    const D r(right), d(down), f(forward);
    const D n = cross(r, d);
    const double determinant = n.x * f.x + n.y * f.y + n.z * f.z;
    by_right_ = over(cross(d, f), determinant);
    by_down_ = over(cross(f, r), determinant);
    by_forward_ = over(n, determinant);
    volume_ = float(std::abs(determinant));
  }

  /// The combination of the axes that `v` is.
  Vector3f coordinates(const Vector3f& v) const {
    return {dot(by_right_, v), dot(by_down_, v), depth(v)};
  }
  /// The last of the coordinates.
  float depth(const Vector3f& v) const { return dot(by_forward_, v); }
  /// What the axes span.
  float volume() const { return volume_; }

 private:
  struct D {
    double x, y, z;
    D(double x_, double y_, double z_) : x(x_), y(y_), z(z_) {}
    explicit D(const Vector3f& v) : D(double(v.x), double(v.y), double(v.z)) {}
  };
  static D cross(const D& a, const D& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  static Vector3f over(const D& v, double s) {
    return {float(v.x / s), float(v.y / s), float(v.z / s)};
  }

  Vector3f by_right_, by_down_, by_forward_;  ///< the rows of the inverse matrix
  float volume_ = 0;
};

/// Whether a film position is one of an image of this size.
inline bool on_film(const Point2f& p, const Point2i& size) {
  return p.x >= 0 && p.x < float(size.x) && p.y >= 0 && p.y < float(size.y);
}

}  // namespace duet
