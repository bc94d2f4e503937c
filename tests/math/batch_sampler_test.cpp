#include "math/batch_sampler.h"

#include <doctest/doctest.h>

#include <memory>

using namespace duet;

TEST_CASE("numbers of many pixels at once are those of each pixel's sampler") {
  constexpr uint64_t kSeed = 11;
  constexpr uint32_t kScramble = 3;
  const auto pixels = std::make_unique<BatchArray<uint64_t>>();
  const auto keys = std::make_unique<BatchKeys>();
  const auto x = std::make_unique<BatchArray<float>>(), y = std::make_unique<BatchArray<float>>();
  for (const SampleSequence sequence : {SampleSequence::independent, SampleSequence::sobol}) {
    BatchSampler batch(sequence, kSeed, kScramble);
    for (int i = 0; i < kBatch; ++i) (*pixels)[i] = batch.pixel_key(1000 + uint64_t(i) * 37);
    // The last is beyond what one Sobol' sequence has.
    for (const uint32_t index : {0u, 1u, 77u, 65'535u, 65'536u + 5}) {
      batch.start_sample(index, kBatch, *pixels, *keys);
      // Also in later blocks of dimensions, and across the end of one.
      for (const uint32_t dimension : {0u, 6u, 15u, 16u, 31u, 43u}) {
        batch.numbers_2d(kBatch, *keys, dimension, *x, *y);
        int same = 0;
        for (int i = 0; i < kBatch; ++i) {
          Sampler one(sequence, kSeed, kScramble, 1000 + uint64_t(i) * 37);
          one.start_sample(index);
          one.start_dimension(dimension);
          same += one.next_2d() == Point2f{(*x)[i], (*y)[i]};
        }
        CHECK(same == kBatch);
        batch.numbers_1d(kBatch, *keys, dimension, *x);
        for (int i = 0; i < kBatch; ++i) {
          Sampler one(sequence, kSeed, kScramble, 1000 + uint64_t(i) * 37);
          one.start_sample(index);
          one.start_dimension(dimension);
          same -= one.next_1d() == (*x)[i];
        }
        CHECK(same == 0);
      }
    }
  }
}
