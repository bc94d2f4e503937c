// Russian roulette of paths (docs/roulette.md).
#pragma once

#include <algorithm>

#include "math/sampler.h"

namespace duet {

/// How roulette decides, from `rr_depth` segments on: a path goes on with a probability in
/// proportion to the share of what it began with that it still carries. The factor of least error
/// for the time grows with what the rest of a path brings to the error of the image, and falls with
/// what it costs (Rath et al., *EARS: Efficiency-Aware Russian Roulette and Splitting*, 2022).
struct Roulette {
  float factor;
  float most;  ///< below one, for paths that lose nothing on their way, as in glass

  float probability(float share) const { return std::min(factor * share, most); }

  /// The same at a vertex `depth` segments from the start. What carries much is let go on surely at
  /// first: light behind a few panes would be noisy for nothing.
  Roulette at(int depth) const { return {factor, depth < kSure ? 1.0f : most}; }
  static constexpr int kSure = 5;
};

/// Of paths that only their own vertices connect with the lights.
inline constexpr Roulette kPathRoulette{4, 0.99f};
/// Of sub-paths: other techniques find a part of what lies beyond, and connections cost more.
inline constexpr Roulette kSubpathRoulette{2, 0.99f};
/// At points of media, which lose little light and come in great numbers.
inline constexpr Roulette kMediaRoulette{2, 0.95f};

/// The probability with which a path goes on, by which its throughput is to be divided; 0 if it
/// ends here.
inline float russian_roulette(const Roulette& roulette, float share, Sampler& sampler) {
  const float probability = roulette.probability(share);
  return sampler.next_1d() < probability ? probability : 0.0f;
}

}  // namespace duet
