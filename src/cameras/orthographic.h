// A camera with parallel rays.
#pragma once

#include "cameras/camera.h"
#include "cameras/film_axes.h"

namespace duet {

struct OrthographicView {
  /// The image shows the camera's x axis from −1 to 1, before this transform.
  Transform to_world;
  Point2i film;  ///< size of the full image in pixels
  double near_clip = 1e-2, far_clip = 1e4;
};

class OrthographicCamera final : public Camera {
 public:
  explicit OrthographicCamera(const OrthographicView& view);
  CameraRay sample_ray(const Point2f& film, const Point2f& lens) const override;
  float importance(const Ray&, float) const override { return importance_; }
  std::optional<CameraSample> sample_lens(const Point3f& from, const Point2f& lens) const override;

 private:
  Point3f corner_;         ///< of the film's upper left, on the near plane
  Vector3f right_, down_;  ///< per pixel
  Vector3f direction_;
  float length_;
  float importance_;
  Point2i film_;
  FilmAxes axes_;  ///< the third is `direction_`
};

/// A telecentric lens: rays leave a disk-shaped aperture around the orthographic camera's and meet
/// in the plane of focus. As in Mitsuba 0.6, points cannot be connected with it.
class TelecentricCamera final : public Camera {
 public:
  /// Radius and distance in world units.
  TelecentricCamera(const OrthographicView& view, double aperture_radius, double focus_distance);
  CameraRay sample_ray(const Point2f& film, const Point2f& lens) const override;
  float importance(const Ray&, float) const override { return 0; }
  std::optional<CameraSample> sample_lens(const Point3f&, const Point2f&) const override {
    return std::nullopt;
  }
  bool has_lens() const override { return true; }
  bool connectible() const override { return false; }

 private:
  Point3f corner_;            ///< of the film's upper left, on the aperture
  Vector3f right_, down_;     ///< per pixel
  Vector3f lens_x_, lens_y_;  ///< the aperture's radii
  Vector3f focus_;            ///< from the aperture to the plane of focus
  float near_, length_;
};

}  // namespace duet
