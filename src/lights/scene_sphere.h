// Where light from infinitely far away enters the scene.
#pragma once

#include "geometry/surface.h"
#include "math/warp.h"

namespace duet {

/// A sphere that holds the scene, with some room to spare.
class SceneSphere {
 public:
  SceneSphere() : SceneSphere(Point3f(0), 1) {}
  SceneSphere(const Point3f& center, float radius)
      : center_(center),
        radius_(std::max(1.001f * radius + kOffsetScale * max_abs(center), 1e-10f)),
        density_(kInvPi / (radius_ * radius_)) {}

  /// A ray without end that comes from the unit direction `wi` and starts outside of the sphere: at
  /// a uniform point of a disk across the direction, whose shadow covers the sphere.
  Ray enter(const Vector3f& wi, const Point2f& u) const {
    const Point2f p = square_to_disk(u) * radius_;
    return {center_ + Frame(Normal3f(wi)).to_world({p.x, p.y, radius_}), -wi, INFINITY};
  }
  /// The same for a ray through a given point.
  Ray enter(const Vector3f& wi, const Point3f& through) const {
    return {through + wi * (dot(center_ - through, wi) + radius_), -wi, INFINITY};
  }
  /// The numbers for which enter() makes the ray through a given point.
  Point2f entry(const Vector3f& wi, const Point3f& through) const {
    const Vector3f p = Frame(Normal3f(wi)).to_local(through - center_) * (1 / radius_);
    return disk_to_square({p.x, p.y});
  }
  /// The density per area of the disk's points.
  float density() const { return density_; }

 private:
  Point3f center_;
  float radius_, density_;
};

}  // namespace duet
