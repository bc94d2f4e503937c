// A volume as the texture of surfaces.
#pragma once

#include "media/volume.h"
#include "textures/texture.h"

namespace duet {

/// Looks up where the surface is in the world, whatever its texture coordinates.
class VolumeTexture final : public Texture {
 public:
  explicit VolumeTexture(const ColorVolumeSlot& volume);
  Spectrum color(const Surface& s) const override { return volume_(s.position); }
  float value(const Surface& s) const override {
    return volume_.grid ? volume_.grid->value(s.position) : volume_.constant.luminance();
  }
  /// As if it did not vary along the surface.
  Point2f gradient(const Surface&) const override { return {0, 0}; }
  Spectrum average() const override { return average_; }
  bool needs_uv() const override { return false; }

 private:
  ColorVolumeSlot volume_;
  Spectrum average_;
};

}  // namespace duet
