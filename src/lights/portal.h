// Light from around the scene that comes in through a window.
#pragma once

#include <array>
#include <memory>

#include "lights/light.h"

namespace duet {

/// The part of an environment that is seen through a rectangle. Rays that leave the scene through
/// its front find the environment, all others find nothing. pbrt-v4 calls this a portal.
///
/// Directions are chosen by the environment's own sample_direct(), in vain where they miss the
/// rectangle, or by uniform points of the rectangle; the density is that of the mixture. Emitted
/// rays have directions of the environment and pass uniform points of the rectangle.
class PortalEnvironment final : public EnvironmentLight {
 public:
  /// Four corners in the world, in order around the rectangle. Rays leave along
  /// (corners[3] − corners[0]) × (corners[1] − corners[0]). `environment_share` is the share of
  /// directions that the environment chooses, in [0, 1].
  PortalEnvironment(std::unique_ptr<EnvironmentLight> environment,
                    const std::array<Point3f, 4>& corners, float environment_share);

  std::optional<LightSample> sample_direct(const Point3f& from, const Point2f& u) const override;
  Spectrum emitted(const Point3f& from, const Vector3f& wi) const override;
  PdfW pdf_direct(const Point3f& from, const Vector3f& wi) const override;
  /// That of what leaves the rectangle's front side, whatever the size of the scene.
  double power(double scene_radius) const override;
  std::optional<EmissionSample> sample_emission(const Point2f& position,
                                                const Point2f& direction) const override;
  float emission_density(const Vector3f& wi) const override;
  void surround(const Point3f& center, float radius) override;
  /// Rays enter by the rectangle.
  const SceneSphere* entered_sphere() const override { return nullptr; }

 private:
  /// The rectangle's density of uniform points per solid angle at `from`; zero if the ray does not
  /// leave through the front.
  float window_density(const Point3f& from, const Vector3f& wi) const;
  PdfW mixed(const Point3f& from, const Vector3f& wi, float window) const;

  std::unique_ptr<EnvironmentLight> environment_;
  Point3f corner_;
  Vector3f sides_[2];
  Normal3f normal_;  ///< to where rays leave
  float area_;
  float share_;
};

}  // namespace duet
