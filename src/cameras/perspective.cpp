#include "cameras/perspective.h"

#include "math/warp.h"

namespace duet {

PerspectiveCamera::PerspectiveCamera(const PerspectiveView& view)
    : eye_(view.to_world(Point3f(0, 0, 0))),
      near_(float(view.near_clip)),
      depth_(float(view.far_clip - view.near_clip)) {
  const double half_width = std::tan(0.5 * view.horizontal_fov * 3.14159265358979323846 / 180);
  // Camera space has +x on the left of the image, film space on the right.
  const double pixel = -2 * half_width / view.film.x;
  right_ = view.to_world(Vector3f(float(pixel), 0, 0));
  down_ = view.to_world(Vector3f(0, float(pixel), 0));
  forward_ = view.to_world(Vector3f(0, 0, 1));
  center_x_ = float(view.film.x * (0.5 - view.offset_x));
  center_y_ = float(view.film.y * (0.5 - view.offset_y));
}

Vector3f PerspectiveCamera::film_direction(const Point2f& film) const {
  return forward_ + (right_ * (film.x - center_x_) + down_ * (film.y - center_y_));
}

Ray PerspectiveCamera::clipped_ray(const Point3f& origin, const Vector3f& direction) const {
  const float l2 = length_squared(direction), inv_length = 1 / std::sqrt(l2);
  return {origin + direction * near_, direction * inv_length, depth_ * (l2 * inv_length)};
}

Ray PerspectiveCamera::sample_ray(const Point2f& film, const Point2f&) const {
  return clipped_ray(eye_, film_direction(film));
}

ThinLensCamera::ThinLensCamera(const PerspectiveView& view, double aperture_radius,
                               double focus_distance)
    : PerspectiveCamera(view),
      lens_x_(view.to_world(Vector3f(float(aperture_radius), 0, 0))),
      lens_y_(view.to_world(Vector3f(0, float(aperture_radius), 0))),
      inv_focus_distance_(float(1 / focus_distance)) {}

Ray ThinLensCamera::sample_ray(const Point2f& film, const Point2f& lens) const {
  const Point2f disk = square_to_disk(lens);
  const Vector3f aside = lens_x_ * disk.x + lens_y_ * disk.y;
  return clipped_ray(eye_ + aside, film_direction(film) - aside * inv_focus_distance_);
}

}  // namespace duet
