#include "cameras/perspective.h"

#include "math/warp.h"

namespace duet {

PerspectiveCamera::PerspectiveCamera(const PerspectiveView& view)
    : to_world_(view.to_world), near_(float(view.near_clip)), far_(float(view.far_clip)) {
  const double half_width = std::tan(0.5 * view.horizontal_fov * 3.14159265358979323846 / 180);
  // Camera space has +x on the left of the image, film space on the right.
  scale_ = float(-2 * half_width / view.film.x);
  center_x_ = float(view.film.x * (0.5 - view.offset_x));
  center_y_ = float(view.film.y * (0.5 - view.offset_y));
}

Vector3f PerspectiveCamera::film_direction(const Point2f& film) const {
  return {(film.x - center_x_) * scale_, (film.y - center_y_) * scale_, 1};
}

Ray PerspectiveCamera::clipped_ray(const Point3f& origin, const Vector3f& direction) const {
  const float inv_z = 1 / direction.z;
  const float near_t = near_ * inv_z;
  const Vector3f d = normalize(to_world_(direction));
  // A scaling transform changes the unit of length along the ray.
  const float stretch = length(to_world_(direction));
  return {to_world_(origin) + d * (near_t * stretch), d, (far_ * inv_z - near_t) * stretch};
}

Ray PerspectiveCamera::sample_ray(const Point2f& film, const Point2f&) const {
  return clipped_ray({0, 0, 0}, normalize(film_direction(film)));
}

ThinLensCamera::ThinLensCamera(const PerspectiveView& view, double aperture_radius,
                               double focus_distance)
    : PerspectiveCamera(view),
      aperture_radius_(float(aperture_radius)),
      focus_distance_(float(focus_distance)) {}

Ray ThinLensCamera::sample_ray(const Point2f& film, const Point2f& lens) const {
  const Point2f disk = square_to_disk(lens) * aperture_radius_;
  const Point3f origin(disk.x, disk.y, 0);
  const Point3f focus = Point3f(film_direction(film) * focus_distance_);
  return clipped_ray(origin, normalize(focus - origin));
}

}  // namespace duet
