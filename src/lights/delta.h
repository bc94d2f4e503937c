// Lights without extent: points and directions, which no ray can find.
#pragma once

#include "lights/light.h"
#include "textures/texture.h"

namespace duet {

/// Sends the same radiant intensity (W/sr) into all directions.
class PointEmitter final : public Light {
 public:
  PointEmitter(const Point3f& position, const Spectrum& intensity)
      : Light(LightKind::position), position_(position), intensity_(intensity) {}
  std::optional<LightSample> sample_direct(const Point3f& from, const Point2f& u) const override;
  double power(double scene_radius) const override;

 private:
  Point3f position_;
  Spectrum intensity_;
};

/// A point that shines into a cone around its +z axis: with full intensity (W/sr) up to the angle
/// `beam_width`, then fading linearly in the angle until `cutoff`. Radians.
class SpotEmitter final : public Light {
 public:
  /// `texture` (or null) multiplies the intensity; the square around the cone at z = 1 is its
  /// domain.
  SpotEmitter(const Transform& to_world, const Spectrum& intensity, double cutoff,
              double beam_width, const Texture* texture);
  std::optional<LightSample> sample_direct(const Point3f& from, const Point2f& u) const override;
  double power(double scene_radius) const override;

 private:
  Transform to_world_;
  Point3f position_;
  Spectrum intensity_;
  double cutoff_, beam_width_;
  float cutoff_angle_, inv_transition_, uv_scale_;
  const Texture* texture_;
};

/// A pinhole camera turned around: throws an image through a frustum along +z such that a plane
/// across the axis sees the image undistorted. `irradiance` times π is what a plane at z = 1
/// receives.
class ProjectorEmitter final : public Light {
 public:
  /// `horizontal_fov` in degrees, of an image `aspect` times as wide as high.
  ProjectorEmitter(const Transform& to_world, const ColorSlot& irradiance, float scale,
                   double horizontal_fov, double aspect);
  std::optional<LightSample> sample_direct(const Point3f& from, const Point2f& u) const override;
  double power(double scene_radius) const override;

 private:
  Transform to_world_;
  Point3f position_;
  Vector3f axis_;  ///< as long as the transform makes it
  ColorSlot irradiance_;
  float scale_;
  float inv_width_, inv_height_;  ///< of the image at z = 1
};

/// Parallel light from infinitely far away.
class DirectionalEmitter final : public Light {
 public:
  /// Light travels along the transform's +z; `irradiance` is that of a plane across. A transform
  /// that stretches z multiplies it, as Mitsuba 3 does.
  DirectionalEmitter(const Transform& to_world, const Spectrum& irradiance);
  std::optional<LightSample> sample_direct(const Point3f& from, const Point2f& u) const override;
  double power(double scene_radius) const override;

 private:
  Vector3f toward_light_;
  Spectrum irradiance_;
};

}  // namespace duet
