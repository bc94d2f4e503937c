// Lines along the edges of fields.
#pragma once

#include "textures/texture.h"

namespace duet {

/// Fields of one colour on the unit squares of texture coordinates, with lines of another, which
/// reach `line_width` into each field.
class GridTexture final : public Texture {
 public:
  GridTexture(const ColorSlot& field, const ColorSlot& line, float line_width,
              const UvTransform& to_uv)
      : field_(field), line_(line), line_width_(line_width), to_uv_(to_uv) {}
  Spectrum color(const Surface& s) const override { return slot(s)(s); }
  float value(const Surface& s) const override { return slot(s)(s).luminance(); }
  Point2f gradient(const Surface&) const override { return {0, 0}; }
  Spectrum average() const override;
  Point2i resolution() const override { return {32, 32}; }

 private:
  const ColorSlot& slot(const Surface& s) const;

  ColorSlot field_, line_;
  float line_width_;
  UvTransform to_uv_;
};

/// Another texture, multiplied by a colour.
class ScaledTexture final : public Texture {
 public:
  ScaledTexture(const Texture& inner, const Spectrum& scale) : inner_(inner), scale_(scale) {}
  Spectrum color(const Surface& s) const override { return inner_.color(s) * scale_; }
  float value(const Surface& s) const override { return inner_.value(s) * scale_.luminance(); }
  Point2f gradient(const Surface& s) const override {
    return inner_.gradient(s) * scale_.luminance();
  }
  Spectrum average() const override { return inner_.average() * scale_; }
  bool needs_uv() const override { return inner_.needs_uv(); }
  Point2i resolution() const override { return inner_.resolution(); }

 private:
  const Texture& inner_;
  Spectrum scale_;
};

}  // namespace duet
