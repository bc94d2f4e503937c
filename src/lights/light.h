// Light interface: how much they send where, and how to choose a direction towards them.
#pragma once

#include <cstdint>
#include <optional>

#include "geometry/surface.h"
#include "lights/light_bounds.h"
#include "lights/scene_sphere.h"
#include "math/measure.h"
#include "math/spectrum.h"

namespace duet {

/// A light seen from a point.
struct LightSample {
  Vector3f wi;      ///< unit direction towards the light
  Point3f target;   ///< a point just before the light's surface; only if `finite`
  Spectrum weight;  ///< incident radiance over the density, or irradiance for delta lights
  PdfW pdf;         ///< at the lit point; zero for delta lights, which no BSDF sample can find
  /// EmissionSample::density of the path that leaves the light along this direction, the other way.
  float emission = 0;
  bool finite = true;  ///< false if the light is infinitely far away
  bool delta = false;
};

/// A ray that starts at a light.
struct EmissionSample {
  Ray ray;            ///< unit direction; starts just off the light's surface, without end
  Spectrum weight;    ///< emitted radiance (intensity, irradiance) over `density`
  float density = 0;  ///< per unit area across the ray and per unit solid angle, so that it is the
                      ///< density of position and direction over |cos θ|; for a light at a point
                      ///< per solid angle alone, for parallel light per area alone
  ShapePoint point;   ///< of an area light
  /// How far along the ray the light enters the scene: what it meets before stays dark.
  float entry = 0;
};

/// Where light comes from when a ray finds it, or why no ray does.
enum class LightKind : uint8_t {
  area,         ///< a surface: found by hits
  environment,  ///< all around the scene: found by rays that leave it
  position,     ///< a single point: found by no ray
  direction,    ///< a single direction, infinitely far away: found by no ray
};

constexpr bool is_delta(LightKind k) {
  return k == LightKind::position || k == LightKind::direction;
}
constexpr bool is_infinite(LightKind k) {
  return k == LightKind::environment || k == LightKind::direction;
}

class Light {
 public:
  explicit Light(LightKind kind) : kind_(kind) {}
  virtual ~Light() = default;

  LightKind kind() const { return kind_; }

  /// A direction from `from` towards the light. Empty if the light does not reach the point.
  /// `from` must be at a distance from the light that its own rounding error does not swallow.
  virtual std::optional<LightSample> sample_direct(const Point3f& from, const Point2f& u) const = 0;

  /// Luminance of the emitted power, or an estimate of it: what the choice among lights goes by.
  /// Lights that are infinitely far away count with what enters a sphere of `scene_radius` that
  /// holds the scene.
  virtual double power(double scene_radius) const = 0;

  /// Where the light is and where it shines, without its power. Nothing if it is infinitely far
  /// away or if no light sample finds it.
  virtual std::optional<LightBounds> bounds() const { return std::nullopt; }

  /// A ray into the scene, chosen in proportion to what the light emits as far as that is known.
  /// Empty if the ray carries nothing.
  virtual std::optional<EmissionSample> sample_emission(const Point2f& position,
                                                        const Point2f& direction) const = 0;
  /// The density per solid angle with which sample_direct(at, …) finds the start of an emitted ray
  /// that has come to `at`. Where sample_direct has no choice, what stands in its place in ratios
  /// of densities: the squared distance of a light at a point, 1 for parallel light.
  virtual float direct_density(const EmissionSample& emission, const Point3f& at) const = 0;
  /// Tells lights that are infinitely far away which sphere holds the scene, before any use.
  virtual void surround(const Point3f&, float) {}
  /// The sphere that rays of sample_emission() enter uniformly, whatever their direction, which
  /// depends on its second argument alone; null if the light does not do so.
  virtual const SceneSphere* entered_sphere() const { return nullptr; }
  /// The second argument of sample_emission() for which it makes a ray in the unit direction `w`,
  /// wherever that starts. Nothing, whatever the direction, if that depends on where it starts.
  virtual std::optional<Point2f> direction_numbers(const Vector3f&) const { return std::nullopt; }

 private:
  LightKind kind_;
};

/// A light that is a surface of the scene.
class SurfaceLight : public Light {
 public:
  SurfaceLight() : Light(LightKind::area) {}
  /// Radiance that leaves a point of the surface in the unit direction `w`.
  virtual Spectrum emitted(const Surface& surface, const Vector3f& w) const = 0;
  /// The density with which sample_direct(from, …) makes the direction to `surface`, which lies at
  /// distance² `d2` in the unit direction `wi`.
  virtual PdfW pdf_direct(const Point3f& from, const Surface& surface, const Vector3f& wi,
                          float d2) const = 0;
  /// EmissionSample::density of a ray that leaves the surface in the unit direction `w`.
  virtual float emission_density(const Surface& surface, const Vector3f& w) const = 0;
};

/// A light that surrounds the scene.
class EnvironmentLight : public Light {
 public:
  EnvironmentLight() : Light(LightKind::environment) {}
  /// Radiance that arrives at `from` from the unit direction `wi`.
  virtual Spectrum emitted(const Point3f& from, const Vector3f& wi) const = 0;
  /// The density with which sample_direct(from, …) makes the direction `wi`.
  virtual PdfW pdf_direct(const Point3f& from, const Vector3f& wi) const = 0;
  /// EmissionSample::density of a ray that comes from the unit direction `wi`.
  virtual float emission_density(const Vector3f& wi) const {
    return pdf_direct({}, wi).value * sphere_.density();
  }
  float direct_density(const EmissionSample& emission, const Point3f& at) const final {
    return pdf_direct(at, -emission.ray.direction).value;
  }
  /// A ray from where sample_direct() says that light comes from, anywhere in the scene.
  std::optional<EmissionSample> sample_emission(const Point2f& position,
                                                const Point2f& direction) const override;
  void surround(const Point3f& center, float radius) override { sphere_ = {center, radius}; }
  const SceneSphere* entered_sphere() const override { return &sphere_; }

 protected:
  const SceneSphere& sphere() const { return sphere_; }
  /// What sample_direct() returns for a direction that it has chosen.
  LightSample from_afar(const Vector3f& wi, const Spectrum& radiance, PdfW pdf) const;
  /// Power that crosses a sphere of this radius under a mean radiance from everywhere.
  static double sphere_power(double radius, double mean);

 private:
  SceneSphere sphere_;
};

}  // namespace duet
