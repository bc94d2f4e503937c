#include "cameras/meters.h"

#include <cmath>

#include "math/frame.h"
#include "math/warp.h"

namespace duet {

RadianceMeter::RadianceMeter(const Transform& to_world)
    : ray_{to_world(Point3f(0)), normalize(to_world(Vector3f(0, 0, 1))), INFINITY} {}

IrradianceMeter::IrradianceMeter(const Shape& shape, const Point2i& film)
    : points_(shape), scale_{1 / float(film.x), 1 / float(film.y)} {}

CameraRay IrradianceMeter::sample_ray(const Point2f& film, const Point2f& lens) const {
  const ShapePoint p = points_.sample({film.x * scale_.x, film.y * scale_.y});
  const Vector3f direction = Frame(p.ns).to_world(square_to_cosine_hemisphere(lens));
  const float side = dot(p.ng, direction) < 0 ? -p.offset : p.offset;
  return {{p.position + Vector3f(p.ng) * side, direction, INFINITY}, kPi};
}

CameraRay FluenceMeter::sample_ray(const Point2f& film, const Point2f&) const {
  const Vector3f w = square_to_sphere({film.x - std::floor(film.x), film.y - std::floor(film.y)});
  return Ray{to_world_(Point3f(0)), normalize(to_world_(w)), INFINITY};
}

DistantMeter::DistantMeter(const Transform& to_world, Shape target)
    : to_world_(to_world), shape_(std::make_unique<Shape>(std::move(target))) {
  points_.emplace(*shape_);
}

void DistantMeter::surround(const Point3f& center, float radius) {
  center_ = center;
  radius_ = std::max(radius * 1.001f, 1e-4f);
  direction_ = normalize(to_world_(Vector3f(0, 0, 1)));
}

CameraRay DistantMeter::sample_ray(const Point2f&, const Point2f& lens) const {
  Point3f target;
  if (point_) {
    target = *point_;
  } else if (points_) {
    target = points_->sample(lens).position;
  } else {
    const Point2f d = square_to_disk(lens) * radius_;
    target = center_ + to_world_(Vector3f(d.x, d.y, 0));
  }
  // From outside of the scene, wherever the target is.
  const float back = distance(target, center_) + 2 * radius_;
  return Ray{target - direction_ * back, direction_, INFINITY};
}

}  // namespace duet
