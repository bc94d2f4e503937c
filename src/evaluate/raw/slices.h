// Which slices of a render are not complete.
#pragma once

#include <cstdint>
#include <vector>

#include "integrators/sample_intervals.h"

namespace duet {

/// A slice, counted from 1, and what it lacks.
struct IncompleteSlice {
  uint32_t number = 1;
  std::vector<SampleInterval> missing;
};

/// Of `slices` slices of `spp` samples per pixel, those that lack samples.
std::vector<IncompleteSlice> incomplete_slices(const SampleIntervals& samples, uint32_t spp,
                                               uint32_t slices);

}  // namespace duet
