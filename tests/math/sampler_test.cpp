#include "math/sampler.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "support/statistics.h"

using namespace duet;

TEST_CASE("every aligned block of 2^k scrambled Sobol' samples is stratified in each dimension") {
  for (const uint64_t pixel : {0u, 1u, 977u})
    for (uint32_t d = 0; d < 40; ++d)
      for (const uint32_t n : {16u, 256u})
        for (const uint32_t first : {0u, n, 5 * n}) {
          std::set<uint32_t> strata;
          Sampler s(SampleSequence::sobol, 7, 0, pixel);
          for (uint32_t i = 0; i < n; ++i) {
            s.start_sample(first + i);
            s.start_dimension(d);
            strata.insert(uint32_t(s.next_1d() * float(n)));
          }
          CHECK(strata.size() == n);
        }
}

TEST_CASE("pairs of dimensions are (0, 2)-nets where the vertices of a path use them") {
  for (const uint32_t d : {0u, 16u, 32u}) {
    for (const int bits : {0, 1, 2, 3, 4}) {  // 16 points in 2^bits × 2^(4 − bits) cells
      std::set<uint32_t> cells;
      Sampler s(SampleSequence::sobol, 3, 0, 11);
      for (uint32_t i = 0; i < 16; ++i) {
        s.start_sample(i);
        s.start_dimension(d);
        const Point2f p = s.next_2d();
        cells.insert(uint32_t(p.x * float(1 << bits)) * 64 + uint32_t(p.y * float(16 >> bits)));
      }
      CHECK(cells.size() == 16);
    }
  }
}

TEST_CASE("numbers depend on seed, batch, pixel, index and dimension, and on nothing else") {
  for (const auto sequence : {SampleSequence::independent, SampleSequence::sobol}) {
    const auto draw = [&](uint64_t seed, uint32_t scramble, uint64_t pixel, uint32_t index,
                          uint32_t dimension) {
      Sampler s(sequence, seed, scramble, pixel);
      s.start_sample(index);
      s.start_dimension(dimension);
      return s.next_1d();
    };
    const float base = draw(1, 2, 3, 4, 5);
    CHECK(base == draw(1, 2, 3, 4, 5));
    CHECK(base != draw(2, 2, 3, 4, 5));
    CHECK(base != draw(1, 3, 3, 4, 5));
    CHECK(base != draw(1, 2, 4, 4, 5));
    CHECK(base != draw(1, 2, 3, 5, 5));
    CHECK(base != draw(1, 2, 3, 4, 6));
    // A sample used out of order, after others, is the same.
    Sampler s(sequence, 1, 2, 3);
    s.start_sample(9);
    s.next_2d();
    s.start_sample(4);
    s.start_dimension(5);
    CHECK(s.next_1d() == base);
  }
}

TEST_CASE("both sequences are uniform and uncorrelated between pixels and dimensions") {
  for (const auto sequence : {SampleSequence::independent, SampleSequence::sobol}) {
    Moments product, mean;
    for (uint64_t pixel = 0; pixel < 4000; ++pixel) {
      Sampler a(sequence, 5, 0, pixel), b(sequence, 5, 0, pixel + 1);
      a.start_sample(0);
      b.start_sample(0);
      const Point2f p = a.next_2d(), q = b.next_2d();
      mean.add(p.x);
      product.add((p.x - 0.5) * (q.x - 0.5) + (p.x - 0.5) * (p.y - 0.5));
    }
    CHECK(std::abs(mean.mean() - 0.5) < 4 * mean.error());
    CHECK(std::abs(product.mean()) < 4 * product.error());
  }
}

TEST_CASE("a sequence that is used up continues with another scramble") {
  Sampler s(SampleSequence::sobol, 1, 0, 0);
  s.start_sample(3);
  const float first = s.next_1d();
  s.start_sample(3 + (1u << kSobolIndexBits));
  CHECK(s.next_1d() != first);
}

TEST_CASE("Sobol' numbers are made group by group, and are those of each dimension by itself") {
  constexpr uint64_t kSeed = 21, kPixel = 5;
  constexpr uint32_t kBatch = 2, kIndex = 300, kCount = 70;
  const uint64_t key = hash_combine(hash_combine(kSeed, kBatch), kPixel);
  // Burley's construction, number by number.
  const auto number = [&](uint32_t d) {
    const uint32_t block = d / kSobolDimensions;
    const uint32_t shuffle = mix32(uint32_t(key) ^ (0x85ebca6bu * block));
    const SobolRow row = sobol_row(block == 0 ? kIndex : shuffle_index(kIndex, shuffle));
    const uint32_t reversed = row.low[d % kSobolDimensions] ^ row.high[d % kSobolDimensions];
    const uint32_t seed = mix32(uint32_t(key >> 32) + 0x9e3779b9u * (d + 1));
    return to_unit_float(owen_scramble_reversed(reversed, seed));
  };
  Sampler s(SampleSequence::sobol, kSeed, kBatch, kPixel);
  s.start_sample(kIndex);
  for (uint32_t d = 0; d < kCount; ++d) CHECK(s.next_1d() == number(d));
  for (uint32_t d = kCount; d-- > 0;) {
    s.start_dimension(d);
    const Point2f p = s.next_2d();
    CHECK(p == Point2f{number(d), number(d + 1)});
  }
}
