// Russian roulette of paths.
#pragma once

#include <algorithm>

#include "math/sampler.h"

namespace duet {

/// The probability with which a path goes on, by which its throughput is to be divided; 0 if it
/// ends here. `survival` is what the path carries, relative to what it began with.
inline float russian_roulette(float survival, Sampler& sampler) {
  const float probability = std::min(survival, 0.95f);
  return sampler.next_1d() < probability ? probability : 0.0f;
}

}  // namespace duet
