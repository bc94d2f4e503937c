// What a render takes in memory, estimated before it begins.
#pragma once

#include <stdexcept>
#include <string>

#include "base/memory_limit.h"
#include "integrators/pass.h"

namespace duet {

/// There is less memory than an image would take.
class TooLittleMemory : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Bytes besides what the scene takes.
struct MemoryEstimate {
  double films = 0;   ///< sums of samples, for all films
  double method = 0;  ///< what the method keeps besides, such as the vertices of light sub-paths
  /// The most that there is at one time of copies: for the estimate of the error, of images that
  /// are developed, converted and encoded, now or for a snapshot.
  double copies = 0;

  double total() const { return films + method + copies; }
};

/// Of a number of films, which are developed and written as images. `data_channels` of their
/// channels are no colours; `half`: colours become 16-bit floats in files.
MemoryEstimate estimate_memory(const FilmContents& contents, size_t data_channels,
                               const FilmLayout& layout, size_t films, bool half);
/// Of a render. To be asked after Integrator::begin().
MemoryEstimate estimate_memory(const Integrator& integrator, const FilmLayout& layout,
                               const RenderBudget& budget, bool half);

/// For people: "the image needs about 1.23 GB of memory (…)".
std::string describe(const MemoryEstimate& estimate);

/// Why there is no room for it beside what is in use already, with all the numbers; empty if there
/// is.
std::string memory_refusal(const MemoryEstimate& estimate, double in_use, const MemoryLimit& limit);

}  // namespace duet
