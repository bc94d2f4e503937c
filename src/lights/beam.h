// Light that leaves in one direction only: no ray and no light sample finds it, only sub-paths that
// start at the light carry it.
#pragma once

#include "geometry/shape_points.h"
#include "lights/light.h"
#include "math/transform.h"
#include "textures/texture.h"

namespace duet {

class Beam : public Light {
 public:
  Beam() : Light(LightKind::position) {}
  std::optional<LightSample> sample_direct(const Point3f&, const Point2f&) const final {
    return std::nullopt;
  }
  float direct_density(const EmissionSample&, const Point3f&) const final { return 0; }
};

/// An infinitely thin beam along the +z axis of a transform, with a power in watts.
class CollimatedBeam final : public Beam {
 public:
  CollimatedBeam(const Transform& to_world, const Spectrum& power);
  double power(double) const override { return double(power_.luminance()); }
  std::optional<EmissionSample> sample_emission(const Point2f& position,
                                                const Point2f& direction) const override;

 private:
  Ray ray_;
  Spectrum power_;
};

/// A surface that shines along its normals: every point sends `flux`, in watts per unit area.
class DirectionalArea final : public Beam {
 public:
  /// `shape` must stay where it is, and be one that ShapePoints takes.
  DirectionalArea(const Shape& shape, const ColorSlot& flux);
  double power(double) const override;
  std::optional<EmissionSample> sample_emission(const Point2f& position,
                                                const Point2f& direction) const override;

 private:
  const Shape& shape_;
  ShapePoints points_;
  ColorSlot flux_;
  double area_;
};

}  // namespace duet
