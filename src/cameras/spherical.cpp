#include "cameras/spherical.h"

#include <cmath>

#include "math/equal_area.h"
#include "math/frame.h"
#include "math/trig.h"

namespace duet {

SphericalCamera::SphericalCamera(const Transform& to_world, const Point2i& film, bool equal_area)
    : eye_(to_world(Point3f(0))),
      x_(normalize(to_world(Vector3f(1, 0, 0)))),
      y_(normalize(to_world(Vector3f(0, 1, 0)))),
      z_(normalize(to_world(Vector3f(0, 0, 1)))),
      film_(film),
      equal_area_(equal_area) {}

/// Film positions of density 1 per pixel, per solid angle: (x, y) = (φ W / 2π, θ H / π).
inline float SphericalCamera::density(float sin_theta) const {
  if (equal_area_) return float(film_.x) * float(film_.y) / (4 * kPi);
  return float(film_.x) * float(film_.y) / (2 * kPi * kPi * std::max(sin_theta, 1e-6f));
}

CameraRay SphericalCamera::sample_ray(const Point2f& film, const Point2f&) const {
  if (equal_area_) {
    const Vector3f d =
        square_to_sphere_equal_area({film.x / float(film_.x), film.y / float(film_.y)});
    return Ray{eye_, normalize(x_ * d.y + y_ * d.z - z_ * d.x), INFINITY};
  }
  float sin_phi, cos_phi, sin_theta, cos_theta;
  sincos_turns(film.x / float(film_.x), sin_phi, cos_phi);
  sincos_turns(0.5f * film.y / float(film_.y), sin_theta, cos_theta);
  const Vector3f w = x_ * (sin_phi * sin_theta) + y_ * cos_theta - z_ * (cos_phi * sin_theta);
  return Ray{eye_, normalize(w), INFINITY};
}

float SphericalCamera::importance(const Ray& ray, float t) const {
  const float cosine = dot(ray.direction, y_);
  return density(safe_sqrt(1 - cosine * cosine)) / (t * t);
}

/// Where a direction is seen, given in the camera's space, at distance r from its y axis.
inline Point2f SphericalCamera::film_position(const Vector3f& d, float r) const {
  if (equal_area_) {
    const Point2f uv = sphere_to_square_equal_area({-d.z, d.x, d.y});
    return {uv.x * float(film_.x), uv.y * float(film_.y)};
  }
  const float turns = atan2_turns(d.x, -d.z);
  return {(turns < 0 ? turns + 1 : turns) * float(film_.x),
          2 * atan2_turns(r, d.y) * float(film_.y)};
}

std::optional<CameraSample> SphericalCamera::sample_lens(const Point3f& from,
                                                         const Point2f&) const {
  const Vector3f v = from - eye_;
  const float d2 = length_squared(v);
  if (!(d2 > 0)) return std::nullopt;
  const Vector3f w = v * (1 / std::sqrt(d2));
  const float x = dot(w, x_), y = dot(w, y_), z = dot(w, z_), r = std::sqrt(x * x + z * z);
  const Point2f film = film_position({x, y, z}, r);
  if (!on_film(film, film_)) return std::nullopt;
  return CameraSample{film, -w, eye_, density(r) / d2};
}

}  // namespace duet
