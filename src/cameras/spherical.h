// A camera that sees all directions.
#pragma once

#include "cameras/camera.h"
#include "cameras/film_axes.h"
#include "math/transform.h"

namespace duet {

/// Takes a picture by latitude and longitude: its first row is the transform's +y, its columns run
/// from −z by +x, +z and −x back to −z.
class SphericalCamera final : public Camera {
 public:
  /// The transform turns and moves, no more.
  SphericalCamera(const Transform& to_world, const Point2i& film);
  Ray sample_ray(const Point2f& film, const Point2f& lens) const override;
  float importance(const Ray& ray, float t) const override;
  std::optional<CameraSample> sample_lens(const Point3f& from, const Point2f& lens) const override;

 private:
  float density(float sin_theta) const;

  Point3f eye_;
  Vector3f x_, y_, z_;
  Point2i film_;
};

}  // namespace duet
