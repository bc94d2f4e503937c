// How the samples of a pass are shared out among threads.
#pragma once

#include <functional>

#include "integrators/integrator.h"

namespace duet {

/// What a tile may be divided into where there are few of them for each thread.
enum class TileSplit {
  by_samples,
  /// And a sample by rows, where a pass is not cancelled before all rows have it.
  by_samples_and_rows
};

/// Calls `work(tile, samples, counters)` for the samples of every tile of a film that is not
/// cancelled before its turn, in parallel, counts them and adds up the counters. Several threads
/// may have parts of one tile, each with sums of its own, which are added to those of the tile: the
/// sums are exact, so that nobody can tell.
void for_each_tile(Film& film, const SampleRange& range, const PassControl& control,
                   TileSplit split, RenderCounters& counters,
                   const std::function<void(FilmTile&, const TileSamples&, RenderCounters&)>& work);

}  // namespace duet
