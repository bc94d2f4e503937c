// Which light, with what probability: one answer for everyone.
#pragma once

#include <span>

#include "math/distribution.h"

namespace duet {

/// Chooses among the lights in proportion to given weights (their power).
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
  /// There must be at least one light.
  Pick pick(float u) const {
    const auto p = distribution_.sample(u);
    return {p.index, p.probability};
  }
  float probability(uint32_t light) const {
    return distribution_.size() == 1 ? 1.0f : distribution_.probability(light);
  }
  size_t size() const { return distribution_.size(); }

 private:
  DiscreteDistribution distribution_;
};

}  // namespace duet
