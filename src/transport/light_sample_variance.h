// How little direct light varies at the first surface that the camera sees, if it is found by light
// samples and rays, which weights count in their favour.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace duet {

/// What the variance of light samples, and of rays that find the light, depends on: given the point
/// of the surface, on the choice of the light, and for lights with extent on where they are sampled
/// and what hides a part of them; over the pixel, on the distance of the light, which is nearer to
/// one side of the pixel than to the other. In two small numbers, because light vertices keep it.
/// The default is that of all other light samples, which count for one.
struct LightSampleVariance {
  static constexpr int kSteps = 255;
  static constexpr int kDistanceBits = 7;

  /// (1 - p + e) / (1 + e) in steps of 1 / kSteps, with p the probability of the light and e the
  /// relative variance that its extent adds.
  uint8_t others = kSteps;
  uint8_t distance = 0;  ///< the power of two of its square, from 2^-64

  LightSampleVariance() = default;
  /// Of a light without extent that is chosen with this probability, at squared distance `d2`, or
  /// infinity.
  LightSampleVariance(float probability, float d2)
      : others(uint8_t(others_of(probability))), distance(uint8_t(distance_of(d2))) {}
  /// Of any light: one without extent (`delta`) or with, infinitely far away or `finite`.
  static LightSampleVariance of(bool delta, bool finite, float probability, float d2) {
    return {certain(delta, finite) * probability, delta && finite ? d2 : INFINITY};
  }

  /// For how many light samples, or rays that find the light, one counts whose surface point has
  /// been chosen uniformly from an area, that of the pixel there: γ of docs/mis.md. Lights with
  /// extent do not ask for the area.
  float gain(float pixel_area) const { return gain(others, distance, pixel_area); }

  // The same in numbers that loops over many take.
  /// By how much less the probability of a light counts because of its extent.
  [[gnu::always_inline]] static float certain(bool delta, bool finite) {
    const float extended = finite ? 1 / (1 + kExtentVariance) : 0.0f;
    return delta ? 1.0f : extended;
  }
  [[gnu::always_inline]] static int others_of(float probability) {
    return int((1 - probability) * float(kSteps) + 0.5f);
  }
  [[gnu::always_inline]] static int distance_of(float d2) {
    const int exponent = int(std::bit_cast<uint32_t>(d2) >> 23) - 127;
    return std::clamp(exponent + 64, 0, (1 << kDistanceBits) - 1);
  }
  [[gnu::always_inline]] static float gain(int others, int distance, float pixel_area) {
    // What is kept of the square of the distance stands for the middle of its octave.
    const float d2 = 1.5f * std::bit_cast<float>(uint32_t(distance - 64 + 127) << 23);
    const float across_pixel = std::min(pixel_area / d2, kMostVariance);
    const float rest = float(others) * (1.0f / float(kSteps));
    return (1 + across_pixel) / std::max(rest + across_pixel, kLeastVariance);
  }

 private:
  // Of finite lights with extent: relative variance by where they are sampled and what hides a part
  // of them, which no technique knows.
  static constexpr float kExtentVariance = 0.25f;
  // So that the weights of techniques that are left with nothing are numbers.
  static constexpr float kLeastVariance = 1e-6f, kMostVariance = 1e6f;
};

}  // namespace duet
