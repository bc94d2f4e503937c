// Lights that surround the scene.
#pragma once

#include <memory>
#include <vector>

#include "lights/light.h"
#include "math/distribution.h"
#include "math/frame.h"
#include "math/transform.h"

namespace duet {

/// The rotation (and mirroring) in a transform, by Gram and Schmidt.
Frame rotation(const Matrix4& m);

/// The same radiance from all directions.
class ConstantEnvironment final : public EnvironmentLight {
 public:
  explicit ConstantEnvironment(const Spectrum& radiance) : radiance_(radiance) {}
  std::optional<LightSample> sample_direct(const Point3f& from, const Point2f& u) const override;
  Spectrum emitted(const Point3f&, const Vector3f&) const override { return radiance_; }
  PdfW pdf_direct(const Point3f&, const Vector3f&) const override { return {0.25f * kInvPi}; }
  double power(double scene_radius) const override;

 private:
  Spectrum radiance_;
};

/// An image around the scene by latitude and longitude. Its first row is the direction +y, its last
/// one −y, so rows are (height − 1) steps apart; the columns run from −z by +x, +z and −x back to
/// −z, and column i of n has its centre at the angle (i + 1/2) / n. Radiance is interpolated
/// bilinearly.
class EnvironmentMap final : public EnvironmentLight {
 public:
  /// `texels` has width × height values of radiance, width ≥ 1 and height ≥ 2. Only the rotation
  /// (and mirroring) of the transform counts.
  EnvironmentMap(int width, int height, std::vector<Spectrum> texels, const Matrix4& to_world);

  std::optional<LightSample> sample_direct(const Point3f& from, const Point2f& u) const override;
  Spectrum emitted(const Point3f&, const Vector3f& wi) const override;
  PdfW pdf_direct(const Point3f&, const Vector3f& wi) const override;
  double power(double scene_radius) const override;
  /// Turns the image as the transform of the constructor does.
  void turn(const Matrix4& to_world) { axes_ = rotation(to_world); }

 private:
  /// A place between four texels: column x (and the next, around the back), row y and the one
  /// below.
  struct Place {
    int x, y;
    float dx, dy;
    float sin_theta;
  };
  Place find(const Vector3f& wi) const;
  const Spectrum& texel(int x, int y) const {
    return texels_[size_t(y) * size_t(width_) + size_t(x < width_ ? x : 0)];
  }
  Spectrum radiance(const Place& p) const;
  /// Value that the density interpolates: luminance times sin θ.
  float weight(int x, int y) const {
    return std::max(texel(x, y).luminance(), 0.0f) * row_weights_[size_t(y)];
  }
  PdfW to_pdf(float density, float sin_theta) const;

  int width_, height_;
  std::vector<Spectrum> texels_;
  std::vector<float> row_weights_;
  BilinearDistribution distribution_;
  Frame axes_;       ///< the image's x, y and z in the world; left-handed if mirrored
  double mean_ = 0;  ///< luminance over the sphere
};

/// Several environments at once: their radiance is the sum. A direction is chosen by one of them,
/// that one by its power.
class EnvironmentSum final : public EnvironmentLight {
 public:
  explicit EnvironmentSum(std::vector<std::unique_ptr<EnvironmentLight>> parts);

  std::optional<LightSample> sample_direct(const Point3f& from, const Point2f& u) const override;
  Spectrum emitted(const Point3f& from, const Vector3f& wi) const override;
  PdfW pdf_direct(const Point3f& from, const Vector3f& wi) const override;
  double power(double scene_radius) const override;

 private:
  std::vector<std::unique_ptr<EnvironmentLight>> parts_;
  DiscreteDistribution choice_;
};

}  // namespace duet
