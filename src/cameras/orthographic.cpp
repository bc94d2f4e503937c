#include "cameras/orthographic.h"

#include "math/warp.h"

namespace duet {

OrthographicCamera::OrthographicCamera(const OrthographicView& view)
    // Mitsuba scales where the rays start, but not how long they are.
    : length_(float(view.far_clip - view.near_clip)), film_(view.film) {
  const float pixel = 2.0f / float(view.film.x);
  const float half_height = 0.5f * pixel * float(view.film.y);
  // Camera space has +x on the left of the image and +y at its top.
  corner_ = view.to_world(Point3f(1, half_height, float(view.near_clip)));
  right_ = view.to_world(Vector3f(-pixel, 0, 0));
  down_ = view.to_world(Vector3f(0, -pixel, 0));
  direction_ = normalize(view.to_world(Vector3f(0, 0, 1)));
  axes_ = FilmAxes(right_, down_, direction_);
  importance_ = 1 / axes_.volume();
}

CameraRay OrthographicCamera::sample_ray(const Point2f& film, const Point2f&) const {
  return Ray{corner_ + (right_ * film.x + down_ * film.y), direction_, length_};
}

std::optional<CameraSample> OrthographicCamera::sample_lens(const Point3f& from,
                                                            const Point2f&) const {
  const Vector3f v = axes_.coordinates(from - corner_);
  if (!(v.z > 0 && v.z <= length_) || !on_film({v.x, v.y}, film_)) return std::nullopt;
  return CameraSample{{v.x, v.y}, -direction_, from - direction_ * v.z, importance_};
}

TelecentricCamera::TelecentricCamera(const OrthographicView& view, double aperture_radius,
                                     double focus_distance)
    : near_(float(view.near_clip)), length_(float(view.far_clip - view.near_clip)) {
  const float pixel = 2.0f / float(view.film.x);
  corner_ = view.to_world(Point3f(1, 0.5f * pixel * float(view.film.y), 0));
  right_ = view.to_world(Vector3f(-pixel, 0, 0));
  down_ = view.to_world(Vector3f(0, -pixel, 0));
  lens_x_ = normalize(view.to_world(Vector3f(1, 0, 0))) * float(aperture_radius);
  lens_y_ = normalize(view.to_world(Vector3f(0, 1, 0))) * float(aperture_radius);
  focus_ = normalize(view.to_world(Vector3f(0, 0, 1))) * float(focus_distance);
}

CameraRay TelecentricCamera::sample_ray(const Point2f& film, const Point2f& lens) const {
  const Point2f disk = square_to_disk(lens);
  const Vector3f aside = lens_x_ * disk.x + lens_y_ * disk.y;
  const Vector3f direction = normalize(focus_ - aside);
  const Point3f origin = corner_ + (right_ * film.x + down_ * film.y) + aside;
  return Ray{origin + direction * near_, direction, length_};
}

}  // namespace duet
