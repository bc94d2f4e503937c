// Lights without extent: points and directions, which no ray can find.
#pragma once

#include "lights/light.h"
#include "lights/scene_sphere.h"
#include "lights/spot_falloff.h"
#include "math/distribution.h"
#include "textures/texture.h"

namespace duet {

/// What lights at a point have in common.
class PositionEmitter : public Light {
 public:
  explicit PositionEmitter(const Point3f& position)
      : Light(LightKind::position), position_(position) {}
  std::optional<LightBounds> bounds() const override {
    return LightBounds::around({position_, position_});
  }
  float direct_density(const EmissionSample&, const Point3f& at) const override {
    return length_squared(at - position_);
  }

 protected:
  Point3f position_;
};

/// Sends the same radiant intensity (W/sr) into all directions.
class PointEmitter final : public PositionEmitter {
 public:
  PointEmitter(const Point3f& position, const Spectrum& intensity)
      : PositionEmitter(position), intensity_(intensity) {}
  std::optional<LightSample> sample_direct(const Point3f& from, const Point2f& u) const override;
  double power(double scene_radius) const override;
  std::optional<EmissionSample> sample_emission(const Point2f& position,
                                                const Point2f& direction) const override;
  std::optional<Point2f> direction_numbers(const Vector3f& w) const override;

 private:
  Spectrum intensity_;
};

/// A point that shines into a cone around its +z axis: with full intensity (W/sr) up to the angle
/// `beam_width`, then fading until `cutoff`. Radians.
class SpotEmitter final : public PositionEmitter {
 public:
  /// `texture` (or null) multiplies the intensity; the square around the cone at z = 1 is its
  /// domain.
  SpotEmitter(const Transform& to_world, const Spectrum& intensity, double cutoff,
              double beam_width, const Texture* texture, SpotFalloff falloff = SpotFalloff::linear);
  std::optional<LightBounds> bounds() const override;
  std::optional<LightSample> sample_direct(const Point3f& from, const Point2f& u) const override;
  double power(double scene_radius) const override;
  /// A direction that is uniform in the cone, before the transform.
  std::optional<EmissionSample> sample_emission(const Point2f& position,
                                                const Point2f& direction) const override;
  std::optional<Point2f> direction_numbers(const Vector3f& w) const override;

 private:
  /// The light at the point that is `away` from the emitter.
  std::optional<LightSample> send(const Vector3f& away) const;
  /// The share of the intensity at an angle less than the cutoff.
  float falloff(float angle) const;

  Transform to_world_;
  Spectrum intensity_;
  double cutoff_, beam_width_;
  float cutoff_angle_, inv_transition_, uv_scale_;
  SpotFalloff falloff_;
  float cos_cutoff_, inv_cosines_;  ///< of a transition by the cosine
  float span_;                      ///< 1 − cos of the cutoff angle
  float density_;  ///< of directions, where the transform leaves lengths as they are
  const Texture* texture_;
};

/// A pinhole camera turned around: throws an image through a frustum along +z such that a plane
/// across the axis sees the image undistorted. `irradiance` times π is what a plane at z = 1
/// receives; or it is the radiant intensity itself.
class ProjectorEmitter final : public PositionEmitter {
 public:
  /// `horizontal_fov` in degrees, of an image `aspect` times as wide as high.
  ProjectorEmitter(const Transform& to_world, const ColorSlot& irradiance, float scale,
                   double horizontal_fov, double aspect, bool is_intensity = false);
  std::optional<LightBounds> bounds() const override;
  std::optional<LightSample> sample_direct(const Point3f& from, const Point2f& u) const override;
  double power(double scene_radius) const override;
  /// A direction by a uniform point of the image.
  std::optional<EmissionSample> sample_emission(const Point2f& position,
                                                const Point2f& direction) const override;

 private:
  /// The light at the point that is `away` from the emitter.
  std::optional<LightSample> send(const Vector3f& away) const;

  Transform to_world_;
  Vector3f axis_;  ///< as long as the transform makes it
  ColorSlot irradiance_;
  float scale_;
  float inv_width_, inv_height_;  ///< of the image at z = 1
  float density_;                 ///< of directions, on the axis if the transform is a rotation
  bool is_intensity_;
};

/// Radiant intensity (W/sr) by an image that is a square of equal areas (math/equal_area.h), texel
/// by texel.
class GoniometricEmitter final : public PositionEmitter {
 public:
  /// `texels` are n rows of n.
  GoniometricEmitter(const Transform& to_world, int n, std::vector<Spectrum> texels);
  /// Puts it elsewhere: the image stays.
  void place(const Transform& to_world);
  std::optional<LightSample> sample_direct(const Point3f& from, const Point2f& u) const override;
  double power(double scene_radius) const override;
  /// A direction by a texel chosen by its luminance.
  std::optional<EmissionSample> sample_emission(const Point2f& position,
                                                const Point2f& direction) const override;

 private:
  /// The light at the point that is `away` from the emitter.
  std::optional<LightSample> send(const Vector3f& away) const;

  Transform to_world_;
  int n_;
  std::vector<Spectrum> texels_;
  DiscreteDistribution choice_;
  float density_;  ///< of directions, times the probability of their texel
};

/// Parallel light from infinitely far away.
class DirectionalEmitter final : public Light {
 public:
  /// Light travels along the transform's +z; `irradiance` is that of a plane across. A transform
  /// that stretches z multiplies it, as Mitsuba 3 does.
  DirectionalEmitter(const Transform& to_world, const Spectrum& irradiance);
  std::optional<LightSample> sample_direct(const Point3f& from, const Point2f& u) const override;
  double power(double scene_radius) const override;
  std::optional<EmissionSample> sample_emission(const Point2f& position,
                                                const Point2f& direction) const override;
  float direct_density(const EmissionSample& emission, const Point3f& at) const override;
  void surround(const Point3f& center, float radius) override { sphere_ = {center, radius}; }
  const SceneSphere* entered_sphere() const override { return &sphere_; }

 private:
  Vector3f toward_light_;
  Spectrum irradiance_;
  SceneSphere sphere_;
};

}  // namespace duet
