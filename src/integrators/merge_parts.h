// In which parts of an image photons should be merged.
// Source: Grittmann et al., "Efficiency-Aware Multiple Importance Sampling for Bidirectional
// Rendering Algorithms", SIGGRAPH 2022, which decides it pixel by pixel.
#pragma once

#include <cstdint>
#include <vector>

#include "integrators/method_prediction.h"

namespace duet {

/// What comes of merging here and there.
struct PartlyMerged {
  std::vector<uint8_t> parts;  ///< of MergeMask's grid; not zero where photons are merged
  double share = 0;            ///< of the parts in which they are
  PredictedMethod prediction;
};

/// The parts with the least product of error and cost, from predictions of a method without merging
/// and of the same with merging. Few sub-paths know each part, so the eight around it have a say,
/// and where merging finds light that nothing else does it stays.
PartlyMerged merge_where_it_pays(const PredictedMethod& without, const PredictedMethod& with);

}  // namespace duet
