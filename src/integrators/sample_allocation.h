// How many samples each tile of an image gets, from how noisy it is.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "integrators/integrator.h"

namespace duet {

/// Samples per pixel that the tiles of an image should get, relative to the mean over all pixels,
/// for the least mean square error: in proportion to the standard deviation of their samples
/// (Neyman, "On the Two Different Aspects of the Representative Method", 1934), which is judged
/// from the spread of independent films with equally many samples. Within bounds, since a few
/// samples do not see what is rare. Noise of splats is left out: no samples of a tile lessen it.
std::vector<double> tile_rates(std::span<const Film> films);

/// What has been dealt out, and at which rates.
struct AllocatedSamples {
  struct Taken {
    double samples = 0;  ///< per pixel, on average
    uint32_t passes = 0;
  };
  std::vector<Taken> taken;  ///< of each film
  double even = 0;           ///< samples per pixel that each film had before rates differed
  std::array<std::vector<double>, 2> rates;  ///< of the tiles in each half of the films
};

/// Deals out samples to the tiles of independent films of one image, evenly at first.
class SampleAllocation {
 public:
  /// `before` is what the films have already; empty for nothing.
  explicit SampleAllocation(std::span<const Film> films, AllocatedSamples before = {});
  const AllocatedSamples& allocated() const { return allocated_; }

  /// From now on tiles get samples at different rates: those of the first half of the films follow
  /// from the second half and those of the second from the first. No sample has a say in how many
  /// others of its film there are, which would be a bias (Kirk & Arvo, "Unbiased Sampling
  /// Techniques for Image Synthesis", 1991).
  void spread();
  bool is_spread() const { return !allocated_.rates[0].empty(); }
  /// Sets the samples in `range` to the next ones of a film, `count` per pixel on average. Its
  /// tiles are valid until the next call.
  void next(size_t film, uint32_t count, SampleRange& range);

 private:
  std::span<const Film> films_;
  AllocatedSamples allocated_;
  std::vector<TileSamples> tiles_;
};

}  // namespace duet
