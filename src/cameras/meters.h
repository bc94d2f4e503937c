// Sensors that measure one quantity rather than show a picture. No point of the scene can be
// connected with them.
#pragma once

#include <optional>

#include "cameras/camera.h"
#include "geometry/shape_points.h"

namespace duet {

class Meter : public Camera {
 public:
  bool connectible() const final { return false; }
  float importance(const Ray&, float) const final { return 0; }
  std::optional<NextRays> next_rays(const Point2f&, const Point2f&) const final {
    return std::nullopt;
  }
  std::optional<CameraSample> sample_lens(const Point3f&, const Point2f&) const final {
    return std::nullopt;
  }
};

/// Radiance along one ray: that of the transform's +z.
class RadianceMeter final : public Meter {
 public:
  explicit RadianceMeter(const Transform& to_world);
  CameraRay sample_ray(const Point2f&, const Point2f&) const override { return ray_; }

 private:
  Ray ray_;
};

/// Irradiance, averaged over a shape: the power per unit area that arrives on its side of the
/// shading normal. The film spans the parameters of the shape.
class IrradianceMeter final : public Meter {
 public:
  IrradianceMeter(const Shape& shape, const Point2i& film);
  CameraRay sample_ray(const Point2f& film, const Point2f& lens) const override;
  bool has_lens() const override { return true; }

 private:
  ShapePoints points_;
  Point2f scale_;
};

/// Radiance averaged over all directions at the origin of the transform.
class FluenceMeter final : public Meter {
 public:
  explicit FluenceMeter(const Transform& to_world) : to_world_(to_world) {}
  CameraRay sample_ray(const Point2f& film, const Point2f& lens) const override;

 private:
  Transform to_world_;
};

/// Radiance that leaves the scene against the direction +z of the transform, averaged over a
/// target: a point, a shape, or the disk that the sphere around the scene shows.
class DistantMeter final : public Meter {
 public:
  explicit DistantMeter(const Transform& to_world) : to_world_(to_world) {}
  DistantMeter(const Transform& to_world, const Point3f& target)
      : to_world_(to_world), point_(target) {}
  DistantMeter(const Transform& to_world, Shape target);
  void surround(const Point3f& center, float radius) override;
  CameraRay sample_ray(const Point2f& film, const Point2f& lens) const override;
  bool has_lens() const override { return true; }

 private:
  Transform to_world_;
  std::optional<Point3f> point_;
  std::unique_ptr<Shape> shape_;
  std::optional<ShapePoints> points_;
  Vector3f direction_;  ///< unit
  Point3f center_{0};
  float radius_ = 1;
};

}  // namespace duet
