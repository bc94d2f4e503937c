#include "cameras/orthographic.h"

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

Ray OrthographicCamera::sample_ray(const Point2f& film, const Point2f&) const {
  return {corner_ + (right_ * film.x + down_ * film.y), direction_, length_};
}

std::optional<CameraSample> OrthographicCamera::sample_lens(const Point3f& from,
                                                            const Point2f&) const {
  const Vector3f v = axes_.coordinates(from - corner_);
  if (!(v.z > 0 && v.z <= length_) || !on_film({v.x, v.y}, film_)) return std::nullopt;
  return CameraSample{{v.x, v.y}, -direction_, from - direction_ * v.z, importance_};
}

}  // namespace duet
