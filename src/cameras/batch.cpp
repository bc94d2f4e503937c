#include "cameras/batch.h"

#include <algorithm>

namespace duet {

CameraBatch::CameraBatch(std::vector<std::unique_ptr<Camera>> cameras, int strip)
    : cameras_(std::move(cameras)), strip_(float(strip)) {
  for (const auto& camera : cameras_) has_lens_ |= camera->has_lens();
}

Ray CameraBatch::sample_ray(const Point2f& film, const Point2f& lens) const {
  // Filters may look beyond the film's edges.
  const float last = float(cameras_.size() - 1);
  const float index = std::clamp(std::floor(film.x / strip_), 0.0f, last);
  return cameras_[size_t(index)]->sample_ray({film.x - index * strip_, film.y}, lens);
}

}  // namespace duet
