// A camera that sees all directions.
#pragma once

#include "cameras/camera.h"
#include "cameras/film_axes.h"
#include "math/transform.h"

namespace duet {

/// Takes a picture by latitude and longitude: its first row is the transform's +y, its columns run
/// from −z by +x, +z and −x back to −z. Or of equal areas (math/equal_area.h): +y is in its middle,
/// −y in its corners, −z in the middle of its right edge and +x in that of the lower one.
class SphericalCamera final : public Camera {
 public:
  /// The transform turns and moves, no more.
  SphericalCamera(const Transform& to_world, const Point2i& film, bool equal_area = false);
  CameraRay sample_ray(const Point2f& film, const Point2f& lens) const override;
  float importance(const Ray& ray, float t) const override;
  std::optional<CameraSample> sample_lens(const Point3f& from, const Point2f& lens) const override;

 private:
  float density(float sin_theta) const;
  Point2f film_position(const Vector3f& local, float r) const;

  Point3f eye_;
  Vector3f x_, y_, z_;
  Point2i film_;
  bool equal_area_;
};

}  // namespace duet
