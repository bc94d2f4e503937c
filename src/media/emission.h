// The light that media emit.
#pragma once

#include <algorithm>
#include <vector>

#include "media/volume.h"

namespace duet {

/// The radiance L_e that the absorbing part of a medium emits: a colour, times that of a black body
/// where a grid gives temperatures.
class MediumEmission {
 public:
  explicit MediumEmission(const ColorVolumeSlot& radiance) : radiance_(radiance) {}
  /// `colors` are those of temperatures from 0 to `hottest` at equal steps, linear in between; at
  /// least two.
  MediumEmission(const ColorVolumeSlot& radiance, const GridVolume& temperature,
                 std::vector<Spectrum> colors, float hottest)
      : radiance_(radiance),
        temperature_(&temperature),
        colors_(std::move(colors)),
        steps_per_kelvin_(float(colors_.size() - 1) / hottest) {}

  Spectrum operator()(const Point3f& p) const {
    const Spectrum radiance = radiance_(p);
    return temperature_ ? radiance * color(temperature_->value(p)) : radiance;
  }
  /// Whether it is the same everywhere.
  bool is_constant() const { return !temperature_ && !radiance_.grid; }

 private:
  Spectrum color(float temperature) const {
    const float last = float(colors_.size() - 1);
    const float x = std::clamp(temperature * steps_per_kelvin_, 0.0f, last);
    const size_t i = std::min(size_t(x), colors_.size() - 2);
    return lerp(colors_[i], colors_[i + 1], x - float(i));
  }

  ColorVolumeSlot radiance_;
  const GridVolume* temperature_ = nullptr;
  std::vector<Spectrum> colors_;
  float steps_per_kelvin_ = 0;
};

}  // namespace duet
