// All that a render has got so far: what is needed to go on, and to put parts of it together.
#pragma once

#include <vector>

#include "image/film.h"
#include "integrators/error_estimate.h"
#include "integrators/sample_allocation.h"
#include "integrators/sample_intervals.h"
#include "transport/counters.h"

namespace duet {

/// Where the rounds of independent batches are, in which all batches get equally many samples.
struct BatchRounds {
  int length = 0;              ///< samples of each batch after the rounds that are complete
  int spp = 0;                 ///< of all batches then
  int part = 1;                ///< samples that the round under way adds to each
  size_t batch = 0;            ///< that gets samples
  uint32_t done = 0;           ///< passes of it
  AllocatedSamples allocated;  ///< when the round began, or will
};

struct RenderState {
  /// One film, or one for each independent batch; empty before the render has begun.
  std::vector<Film> films;
  /// The samples of a single film.
  SampleIntervals samples;
  VarianceSum variance;  ///< of its samples
  BatchRounds rounds;    ///< if there are batches
  int spp = 0;           ///< samples that pixels have on average, of complete passes
  RenderCounters counters;
  double seconds = 0;  ///< including the choice of a method
};

}  // namespace duet
