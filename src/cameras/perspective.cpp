#include "cameras/perspective.h"

#include "math/angles.h"
#include "math/warp.h"

namespace duet {

PerspectiveCamera::PerspectiveCamera(const PerspectiveView& view)
    : eye_(view.to_world(Point3f(0, 0, 0))),
      near_(float(view.near_clip)),
      depth_(float(view.far_clip - view.near_clip)),
      film_(view.film) {
  const double half_width = std::tan(0.5 * view.horizontal_fov * kRadians);
  // Camera space has +x on the left of the image, film space on the right.
  const double pixel = -2 * half_width / view.film.x;
  right_ = view.to_world(Vector3f(float(pixel), 0, 0));
  down_ = view.to_world(Vector3f(0, float(pixel), 0));
  forward_ = view.to_world(Vector3f(0, 0, 1));
  center_x_ = float(view.film.x * (0.5 - view.offset_x));
  center_y_ = float(view.film.y * (0.5 - view.offset_y));
  axes_ = FilmAxes(right_, down_, forward_);
}

Vector3f PerspectiveCamera::film_direction(const Point2f& film) const {
  return forward_ + (right_ * (film.x - center_x_) + down_ * (film.y - center_y_));
}

Ray PerspectiveCamera::clipped_ray(const Point3f& origin, const Vector3f& direction) const {
  const float l2 = length_squared(direction), inv_length = 1 / std::sqrt(l2);
  return {origin + direction * near_, direction * inv_length, depth_ * (l2 * inv_length)};
}

CameraRay PerspectiveCamera::sample_ray(const Point2f& film, const Point2f&) const {
  return clipped_ray(eye_, film_direction(film));
}

float PerspectiveCamera::importance(const Ray& ray, float t) const {
  // The depth per length: cos θ, unless the transform stretches. Rays start on the near plane.
  const float slope = axes_.depth(ray.direction);
  const float distance = t + near_ / slope;
  return 1 / (axes_.volume() * slope * slope * slope * distance * distance);
}

std::optional<CameraSample> PerspectiveCamera::seen_from(const Point3f& origin,
                                                         const Vector3f& shift,
                                                         const Point3f& from) const {
  const Vector3f v = from - origin;
  const float depth = axes_.depth(v);
  if (!(depth > near_ && depth <= near_ + depth_)) return std::nullopt;
  const Vector3f direction = v * (1 / depth), film = axes_.coordinates(direction + shift);
  const Point2f position{film.x + center_x_, film.y + center_y_};
  if (!on_film(position, film_)) return std::nullopt;
  const float distance = length(v);
  return CameraSample{position, v * (-1 / distance), origin + direction * near_,
                      distance / (axes_.volume() * depth * depth * depth)};
}

std::optional<CameraSample> PerspectiveCamera::sample_lens(const Point3f& from,
                                                           const Point2f&) const {
  return seen_from(eye_, Vector3f(0), from);
}

ThinLensCamera::ThinLensCamera(const PerspectiveView& view, const ThinLens& lens)
    : PerspectiveCamera(view),
      lens_x_(view.to_world(Vector3f(float(lens.radius), 0, 0))),
      lens_y_(view.to_world(Vector3f(0, float(lens.radius * lens.aspect), 0))),
      inv_focus_distance_(float(1 / lens.focus_distance)) {}

inline Vector3f ThinLensCamera::lens_point(const Point2f& lens) const {
  const Point2f disk = square_to_disk(lens);
  return lens_x_ * disk.x + lens_y_ * disk.y;
}

CameraRay ThinLensCamera::sample_ray(const Point2f& film, const Point2f& lens) const {
  const Vector3f aside = lens_point(lens);
  return clipped_ray(eye_ + aside, film_direction(film) - aside * inv_focus_distance_);
}

std::optional<CameraSample> ThinLensCamera::sample_lens(const Point3f& from,
                                                        const Point2f& lens) const {
  const Vector3f aside = lens_point(lens);
  return seen_from(eye_ + aside, aside * inv_focus_distance_, from);
}

DistortedCamera::DistortedCamera(const PerspectiveView& view, double k0, double k1)
    : PerspectiveCamera(view), k0_(float(k0)), k1_(float(k1)) {}

inline float DistortedCamera::stretch(float r2) const {
  return std::abs((1 + r2 * (k0_ + r2 * k1_)) * (1 + r2 * (3 * k0_ + 5 * k1_ * r2)));
}

CameraRay DistortedCamera::sample_ray(const Point2f& film, const Point2f&) const {
  const Vector3f shown = film_direction(film) - forward_;
  const float y = length(shown);
  // Newton's method from the distorted distance.
  float r = y;
  for (int i = 0; i < 8 && y > 0; ++i) {
    const float r2 = r * r;
    const float off = r * (1 + r2 * (k0_ + r2 * k1_)) - y;
    r -= off / (1 + r2 * (3 * k0_ + 5 * k1_ * r2));
  }
  return clipped_ray(eye_, forward_ + shown * (y > 0 ? r / y : 1.0f));
}

float DistortedCamera::importance(const Ray& ray, float t) const {
  const float slope = axes_.depth(ray.direction);
  return PerspectiveCamera::importance(ray, t) * stretch(1 / (slope * slope) - 1);
}

std::optional<CameraSample> DistortedCamera::sample_lens(const Point3f& from,
                                                         const Point2f&) const {
  const Vector3f v = from - eye_;
  const float depth = axes_.depth(v);
  if (!(depth > near_ && depth <= near_ + depth_)) return std::nullopt;
  const Vector3f direction = v * (1 / depth), aside = direction - forward_;
  const float r2 = length_squared(aside);
  // Beyond the radius where the polynomial turns around, no film position leads to the point.
  for (int i = 1; i <= 8; ++i) {
    const float q = r2 * sqr(float(i) / 8);
    if (!(1 + q * (3 * k0_ + 5 * k1_ * q) > 0)) return std::nullopt;
  }
  const Vector3f film = axes_.coordinates(forward_ + aside * (1 + r2 * (k0_ + r2 * k1_)));
  const Point2f position{film.x + center_x_, film.y + center_y_};
  if (!on_film(position, film_)) return std::nullopt;
  const float distance = length(v);
  return CameraSample{position, v * (-1 / distance), eye_ + direction * near_,
                      stretch(r2) * distance / (axes_.volume() * depth * depth * depth)};
}

}  // namespace duet
