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
  Ray sample_ray(const Point2f& film, const Point2f& lens) const override;
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

}  // namespace duet
