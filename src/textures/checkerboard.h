// Squares of two colours.
#pragma once

#include "textures/texture.h"

namespace duet {

/// Two by two fields on the unit square of texture coordinates, repeated everywhere; the first
/// colour lies at the origin.
class Checkerboard final : public Texture {
 public:
  /// Asked for a number, Mitsuba 3 exchanges the two colours; `swap_values` does, too.
  Checkerboard(const ColorSlot& first, const ColorSlot& second, const UvTransform& to_uv,
               bool swap_values);

  Spectrum color(const Surface& s) const override;
  float value(const Surface& s) const override;
  /// Zero wherever it exists.
  Point2f gradient(const Surface&) const override { return {0, 0}; }
  Spectrum average() const override { return (first_.average() + second_.average()) * 0.5f; }
  Point2i resolution() const override { return {2, 2}; }

 private:
  bool on_first(const Point2f& uv) const;

  ColorSlot first_, second_;
  UvTransform to_uv_;
  bool swap_values_;
};

}  // namespace duet
