// The curvature of surfaces as a colour.
#pragma once

#include "geometry/curvature.h"
#include "textures/curvature_kind.h"
#include "textures/shape_texture.h"

namespace duet {

/// The mean or the Gaussian curvature times a scale: positive values as red, negative ones as blue,
/// both up to 1. As in Mitsuba 0.6.
class CurvatureMap final : public ShapeTexture {
 public:
  CurvatureMap(CurvatureKind shown, float scale) : shown_(shown), scale_(scale) {}

  std::string add_shape(const Shape& shape, bool is_mesh) override;

  Spectrum color(const Surface& s) const override;
  float value(const Surface& s) const override { return color(s).luminance(); }
  /// By differences.
  Point2f gradient(const Surface& s) const override;
  /// Unknown: in the middle of what there can be, as in Mitsuba.
  Spectrum average() const override { return Spectrum(0.5f); }

 private:
  CurvatureKind shown_;
  float scale_;
};

}  // namespace duet
