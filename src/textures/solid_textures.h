// Textures that are functions of the point in space, whatever surface it is on.
#pragma once

#include "textures/space_map.h"
#include "textures/texture.h"

namespace duet {

/// Derivatives of value() by the texture coordinates, by finite differences along the tangents of
/// the surface, of a texture that looks at nothing but the position.
Point2f gradient_in_space(const Texture& texture, const Surface& s);

struct NoiseOptions {
  NoiseKind kind = NoiseKind::fbm;
  int octaves = 8;
  float roughness = 0.5f;
  /// Of marble: multiplies the point, and by how much noise moves it.
  float scale = 1, variation = 0.2f;
};

class NoiseTexture final : public Texture {
 public:
  NoiseTexture(const NoiseOptions& options, const SpaceMap& map);
  Spectrum color(const Surface& s) const override;
  float value(const Surface& s) const override;
  Point2f gradient(const Surface& s) const override { return gradient_in_space(*this, s); }
  /// Of points of a box that repeats; noise may be negative.
  Spectrum average() const override { return average_; }
  bool needs_uv() const override { return false; }

 private:
  float noise_at(const Point3f& p) const;
  Spectrum marble_at(const Point3f& p) const;

  NoiseOptions options_;
  SpaceMap map_;
  Spectrum average_;
};

/// Unit cubes of two colours; the first one lies at the origin.
class SolidCheckerboard final : public Texture {
 public:
  SolidCheckerboard(const ColorSlot& first, const ColorSlot& second, const SpaceMap& map)
      : first_(first), second_(second), map_(map) {}
  Spectrum color(const Surface& s) const override { return slot(s)(s); }
  float value(const Surface& s) const override;
  /// Zero wherever it exists, but for that of the two textures, which is left out.
  Point2f gradient(const Surface&) const override { return {0, 0}; }
  Spectrum average() const override { return (first_.average() + second_.average()) * 0.5f; }
  bool needs_uv() const override { return any_of(first_, second_); }

 private:
  static bool any_of(const ColorSlot& a, const ColorSlot& b) {
    return a.needs_uv() || b.needs_uv();
  }
  const ColorSlot& slot(const Surface& s) const;

  ColorSlot first_, second_;
  SpaceMap map_;
};

/// Another texture, looked up at coordinates that follow from the point in space.
class MappedTexture final : public Texture {
 public:
  MappedTexture(const Texture& inner, SpaceMapKind kind, const SpaceMap& map)
      : inner_(inner), kind_(kind), map_(map) {}
  Spectrum color(const Surface& s) const override { return inner_.color(mapped(s)); }
  float value(const Surface& s) const override { return inner_.value(mapped(s)); }
  Point2f gradient(const Surface& s) const override { return gradient_in_space(*this, s); }
  Spectrum average() const override { return inner_.average(); }
  bool needs_uv() const override { return false; }

 private:
  Surface mapped(const Surface& s) const {
    Surface there = s;
    there.uv = texture_coordinates(kind_, map_(s.position));
    return there;
  }

  const Texture& inner_;
  SpaceMapKind kind_;
  SpaceMap map_;
};

}  // namespace duet
