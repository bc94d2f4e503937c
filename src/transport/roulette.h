// Russian roulette of paths.
#pragma once

#include <algorithm>

#include "math/sampler.h"

namespace duet {

/// The probability with which roulette lets a path go on that carries `survival`, relative to what
/// it began with.
inline float roulette_probability(float survival) {
  return std::min(survival, 0.95f);
}

/// The probability with which a path goes on, by which its throughput is to be divided; 0 if it
/// ends here.
inline float russian_roulette(float survival, Sampler& sampler) {
  const float probability = roulette_probability(survival);
  return sampler.next_1d() < probability ? probability : 0.0f;
}

}  // namespace duet
