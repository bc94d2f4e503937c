// A choice among lights that is the same everywhere.
#pragma once

#include <memory>
#include <span>

#include "lights/light.h"
#include "math/distribution.h"

namespace duet {

/// The weights with which lights are to be chosen: half of them the same for all lights that shine
/// at all, because power says nothing about distance; half in proportion to power. So the variance
/// is at most twice that of either choice alone. The power of lights that are infinitely far away
/// grows with the scene's size and says little about how much of it counts: if there are both
/// kinds, each gets half of the second half. `factors` (one per light) multiply the result.
std::vector<float> selection_weights(std::span<const std::unique_ptr<Light>> lights,
                                     std::span<const double> factors, double scene_radius);

/// Chooses among the lights in proportion to given weights. A light alone is chosen always, even if
/// its weight is zero.
class LightPicker {
 public:
  LightPicker() = default;
  explicit LightPicker(std::span<const float> weights) {
    if (!weights.empty()) distribution_ = DiscreteDistribution(weights);
  }

  struct Pick {
    uint32_t light;
    float probability;
  };
  /// There must be at least one light. `others` as in fine_variate().
  Pick pick(float u, const Point2f& others) const {
    const auto p = distribution_.sample(u, others);
    return {p.index, p.probability};
  }
  float probability(uint32_t light) const { return distribution_.probability(light); }
  size_t size() const { return distribution_.size(); }

 private:
  DiscreteDistribution distribution_;
};

}  // namespace duet
