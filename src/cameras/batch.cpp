#include "cameras/batch.h"

#include <algorithm>

namespace duet {

CameraBatch::CameraBatch(std::vector<std::unique_ptr<Camera>> cameras, int strip)
    : cameras_(std::move(cameras)), strip_(float(strip)) {
  for (const auto& camera : cameras_) has_lens_ |= camera->has_lens();
}

inline const Camera& CameraBatch::camera_at(Point2f& film) const {
  // Filters may look beyond the film's edges.
  const float last = float(cameras_.size() - 1);
  const float index = std::clamp(std::floor(film.x / strip_), 0.0f, last);
  film.x -= index * strip_;
  return *cameras_[size_t(index)];
}

CameraRay CameraBatch::sample_ray(const Point2f& film, const Point2f& lens) const {
  Point2f own = film;
  return camera_at(own).sample_ray(own, lens);
}

std::optional<NextRays> CameraBatch::next_rays(const Point2f& film, const Point2f& lens) const {
  Point2f own = film;
  return camera_at(own).next_rays(own, lens);
}

}  // namespace duet
