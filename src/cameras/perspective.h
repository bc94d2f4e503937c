// Pinhole and thin-lens cameras.
#pragma once

#include "cameras/camera.h"
#include "cameras/film_axes.h"

namespace duet {

/// What both have in common: a frustum of rays along +z of the camera's space.
struct PerspectiveView {
  Transform to_world;
  Point2i film;                ///< size of the full image in pixels
  double horizontal_fov = 45;  ///< degrees
  /// Where the optical axis meets the film, left of and above its centre, in widths and heights.
  double offset_x = 0, offset_y = 0;
  double near_clip = 1e-2, far_clip = 1e4;
};

class PerspectiveCamera : public Camera {
 public:
  explicit PerspectiveCamera(const PerspectiveView& view);
  CameraRay sample_ray(const Point2f& film, const Point2f& lens) const override;
  float importance(const Ray& ray, float t) const override;
  std::optional<CameraSample> sample_lens(const Point3f& from, const Point2f& lens) const override;

 protected:
  /// From the eye to the point that is seen at a film position, at depth 1; in world space.
  Vector3f film_direction(const Point2f& film) const;
  /// A ray from `origin` between the clipping planes; `direction` spans a depth of 1.
  Ray clipped_ray(const Point3f& origin, const Vector3f& direction) const;
  /// The line from a point to the point `origin` of the lens, whose rays have the direction of the
  /// film less `shift`.
  std::optional<CameraSample> seen_from(const Point3f& origin, const Vector3f& shift,
                                        const Point3f& from) const;

  Point3f eye_;
  Vector3f right_, down_;  ///< by one pixel, at depth 1
  Vector3f forward_;
  float center_x_, center_y_;
  float near_, depth_;
  Point2i film_;
  FilmAxes axes_;
};

/// A lens, in the camera's space.
struct ThinLens {
  double radius;  ///< of the aperture, across the image
  double focus_distance;
  double aspect = 1;  ///< of the aperture: height over width
};

/// Rays leave an aperture, an ellipse, and meet in the plane of focus.
class ThinLensCamera final : public PerspectiveCamera {
 public:
  ThinLensCamera(const PerspectiveView& view, const ThinLens& lens);
  CameraRay sample_ray(const Point2f& film, const Point2f& lens) const override;
  std::optional<CameraSample> sample_lens(const Point3f& from, const Point2f& lens) const override;
  bool has_lens() const override { return true; }

 private:
  /// From the centre of the lens to one of its points.
  Vector3f lens_point(const Point2f& lens) const;

  Vector3f lens_x_, lens_y_;  ///< the aperture's radii
  float inv_focus_distance_;
};

/// A pinhole camera whose picture is distorted radially: what lies at the distance r from the axis,
/// at depth 1, is shown at r (1 + k₀ r² + k₁ r⁴). The transform must not stretch.
/// Source: Brown, "Decentering Distortion of Lenses", 1966, the radial part.
class DistortedCamera final : public PerspectiveCamera {
 public:
  DistortedCamera(const PerspectiveView& view, double k0, double k1);
  CameraRay sample_ray(const Point2f& film, const Point2f& lens) const override;
  float importance(const Ray& ray, float t) const override;
  std::optional<CameraSample> sample_lens(const Point3f& from, const Point2f& lens) const override;

 private:
  /// Film area per area without distortion, at the squared distance r2 from the axis.
  float stretch(float r2) const;

  float k0_, k1_;
};

}  // namespace duet
