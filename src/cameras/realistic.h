// A camera whose lenses are traced surface by surface.
#pragma once

#include "cameras/camera.h"
#include "cameras/lens_system.h"
#include "math/transform.h"

namespace duet {

/// A pixel is the irradiance of the film, as the light's power per area; or, if it is relative to
/// the pupil, the mean radiance times cos⁴ and the share of the pupil on the axis, which does not
/// change as the stop is closed. Most points of the scene are seen through many points of the lens,
/// and finding these is not attempted: none can be connected with the camera.
/// Source: Kolb, Mitchell & Hanrahan, "A Realistic Camera Model for Computer Graphics", 1995.
class RealisticCamera final : public Camera {
 public:
  /// The film has a diagonal of `diagonal` and is as wide as it is high times the ratio of `film`.
  /// The transform moves the lens system's space, whose +x is on the left of the image.
  RealisticCamera(const Transform& to_world, const Point2i& film, double diagonal, LensSystem lens,
                  bool relative_to_pupil);
  CameraRay sample_ray(const Point2f& film, const Point2f& lens) const override;
  std::optional<NextRays> next_rays(const Point2f& film, const Point2f& lens) const override;
  float importance(const Ray&, float) const override { return 0; }
  std::optional<CameraSample> sample_lens(const Point3f&, const Point2f&) const override {
    return std::nullopt;
  }
  bool has_lens() const override { return true; }
  bool connectible() const override { return false; }

  const ExitPupil& pupil() const { return pupil_; }
  void place(const Transform& to_world) { to_world_ = to_world; }

 private:
  Transform to_world_;
  LensSystem lens_;
  double pixel_;                ///< the size of one
  double center_x_, center_y_;  ///< in pixels
  ExitPupil pupil_;
  double weight_;  ///< of radiance, per area of the pupil and cos⁴
};

}  // namespace duet
