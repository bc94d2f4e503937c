#include "evaluate/raw/slices.h"

namespace duet {

std::vector<IncompleteSlice> incomplete_slices(const SampleIntervals& samples, uint32_t spp,
                                               uint32_t slices) {
  std::vector<IncompleteSlice> found;
  for (uint32_t k = 1; k <= slices; ++k) {
    std::vector<SampleInterval> missing = samples.missing_from(slice_of(spp, k, slices));
    if (!missing.empty()) found.push_back({k, std::move(missing)});
  }
  return found;
}

}  // namespace duet
