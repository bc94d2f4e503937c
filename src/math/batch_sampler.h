// The random numbers of one sample of many pixels at once: the same as Sampler hands out.
#pragma once

#include "math/batch.h"
#include "math/sampler.h"

namespace duet {

/// What tells the samples of a batch apart.
struct BatchKeys {
  BatchArray<uint32_t> high, low;
};

/// See Sampler, whose numbers these are, for the arguments.
class BatchSampler {
 public:
  BatchSampler(SampleSequence sequence, uint64_t seed, uint32_t scramble)
      : sequence_(sequence), seed_key_(hash_combine(seed, scramble)) {}

  uint64_t pixel_key(uint64_t pixel) const { return hash_combine(seed_key_, pixel); }
  /// Continues at sample `index` of the first `n` pixels, given by their keys.
  void start_sample(uint32_t index, int n, const BatchArray<uint64_t>& pixels, BatchKeys& keys);
  /// Tells the batch and the sample apart: of random numbers that paths have in common.
  uint64_t batch_key(const BatchKeys& keys) const {
    return hash_combine(uint64_t(keys.high[0]) << 32 | keys.low[0], index_);
  }
  /// Sampler::next_1d() at a dimension, for the first `n` keys.
  void numbers_1d(int n, const BatchKeys& keys, uint32_t dimension, BatchArray<float>& u) const;
  /// Sampler::next_2d().
  void numbers_2d(int n, const BatchKeys& keys, uint32_t dimension, BatchArray<float>& x,
                  BatchArray<float>& y) const;

 private:
  SampleSequence sequence_;
  uint64_t seed_key_;
  uint32_t index_ = 0;  ///< within a Sobol' sequence
};

}  // namespace duet
