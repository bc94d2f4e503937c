// Random numbers for tracking in media, which takes nobody knows how many.
#pragma once

#include "math/hash.h"

namespace duet {

/// Independent numbers in [0, 1): a counter that is hashed.
/// Source: Steele et al., "Fast Splittable Pseudorandom Number Generators", 2014 (SplitMix64).
class RandomStream {
 public:
  explicit RandomStream(uint64_t seed) : state_(seed) {}
  float next() {
    state_ += kStep;
    return to_unit_float(uint32_t(mix64(state_) >> 32));
  }
  /// How many numbers have been drawn since `earlier`, a copy of this stream.
  uint64_t drawn_since(const RandomStream& earlier) const {
    return (state_ - earlier.state_) * kInverseStep;
  }

 private:
  static constexpr uint64_t kStep = 0x9e3779b97f4a7c15ull, kInverseStep = 0xf1de83e19937733dull;
  static_assert(kStep * kInverseStep == 1);
  uint64_t state_;
};

}  // namespace duet
