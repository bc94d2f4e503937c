#include "math/batch_sampler.h"

#include "base/instruction_sets.h"

namespace duet {

namespace {

/// One dimension of the first block of Sobol' points, in which all pixels have the same point.
DUET_WIDEST void scramble_point(int n, uint32_t reversed, const BatchKeys& keys, uint32_t dimension,
                                BatchArray<float>& u) {
  DUET_LANES
  for (int i = 0; i < n; ++i)
    u[i] = to_unit_float(owen_scramble_reversed(reversed, scramble_seed(keys.high[i], dimension)));
}

/// The reversed coordinate of a point in a dimension.
[[gnu::always_inline]] inline uint32_t coordinate(uint32_t point, uint32_t dimension) {
  const uint32_t* const low = &sobol_detail::kRows[0][0][dimension % kSobolDimensions];
  const uint32_t* const high = &sobol_detail::kRows[1][0][dimension % kSobolDimensions];
  return low[int(point & 255) * kSobolDimensions] ^
         high[int((point >> 8) & 255) * kSobolDimensions];
}

DUET_WIDEST void scramble_shuffled(int n, uint32_t index, const BatchKeys& keys, uint32_t dimension,
                                   BatchArray<float>& u) {
  const uint32_t block = dimension / kSobolDimensions;
  DUET_LANES
  for (int i = 0; i < n; ++i) {
    const uint32_t x = coordinate(shuffled_point(index, keys.low[i], block), dimension);
    u[i] = to_unit_float(owen_scramble_reversed(x, scramble_seed(keys.high[i], dimension)));
  }
}

/// The same for two dimensions of one block.
DUET_WIDEST void scramble_shuffled(int n, uint32_t index, const BatchKeys& keys, uint32_t dimension,
                                   BatchArray<float>& u, BatchArray<float>& v) {
  const uint32_t block = dimension / kSobolDimensions;
  DUET_LANES
  for (int i = 0; i < n; ++i) {
    const uint32_t point = shuffled_point(index, keys.low[i], block);
    const uint32_t x = coordinate(point, dimension), y = coordinate(point, dimension + 1);
    u[i] = to_unit_float(owen_scramble_reversed(x, scramble_seed(keys.high[i], dimension)));
    v[i] = to_unit_float(owen_scramble_reversed(y, scramble_seed(keys.high[i], dimension + 1)));
  }
}

DUET_WIDEST void draw(int n, const BatchKeys& keys, uint64_t salt, BatchArray<float>& x,
                      BatchArray<float>& y) {
  DUET_LANES
  for (int i = 0; i < n; ++i) {
    const uint64_t bits = mix64((uint64_t(keys.high[i]) << 32 | keys.low[i]) + salt);
    x[i] = to_unit_float(uint32_t(bits >> 32));
    y[i] = to_unit_float(uint32_t(bits));
  }
}

}  // namespace

void BatchSampler::start_sample(uint32_t index, int n, const BatchArray<uint64_t>& pixels,
                                BatchKeys& keys) {
  index_ = index & ((1u << kSobolIndexBits) - 1);
  const uint32_t round = index >> kSobolIndexBits;
  for (int i = 0; i < n; ++i) {
    uint64_t key = pixels[i];
    if (sequence_ == SampleSequence::independent)
      key = mix64(key + index);
    else if (round != 0)
      key = hash_combine(key, round);
    keys.high[i] = uint32_t(key >> 32), keys.low[i] = uint32_t(key);
  }
}

void BatchSampler::numbers_1d(int n, const BatchKeys& keys, uint32_t dimension,
                              BatchArray<float>& u) const {
  if (sequence_ == SampleSequence::independent) {
    BatchArray<float> unused;
    draw(n, keys, dimension_salt(dimension), u, unused);
  } else if (dimension < kSobolDimensions) {
    const SobolRow row = sobol_row(index_);
    scramble_point(n, row.low[dimension] ^ row.high[dimension], keys, dimension, u);
  } else {
    scramble_shuffled(n, index_, keys, dimension, u);
  }
}

void BatchSampler::numbers_2d(int n, const BatchKeys& keys, uint32_t dimension,
                              BatchArray<float>& x, BatchArray<float>& y) const {
  if (sequence_ == SampleSequence::independent) {
    draw(n, keys, dimension_salt(dimension), x, y);
  } else if (dimension >= kSobolDimensions && dimension % kSobolDimensions < kSobolDimensions - 1) {
    scramble_shuffled(n, index_, keys, dimension, x, y);
  } else {
    numbers_1d(n, keys, dimension, x);
    numbers_1d(n, keys, dimension + 1, y);
  }
}

}  // namespace duet
