// Sobol' points by index, for the Owen-scrambled sampler.
#pragma once

#include <array>
#include <cstdint>

#include "math/hash.h"

namespace duet {

inline constexpr int kSobolDimensions = 16;
/// So many dimensions, from a multiple of this number on, are scrambled at once.
inline constexpr uint32_t kSobolGroup = 8;
/// Sample indices use this many low bits; a sequence may have 65,536 points before it repeats.
inline constexpr int kSobolIndexBits = 16;

namespace sobol_detail {
/// rows[byte][value][dimension]: the xor of the direction numbers of the bits set in `value`, with
/// the bits of each number reversed (the radix point after bit 0), as the scramble wants them.
using Table = std::array<std::array<std::array<uint32_t, kSobolDimensions>, 256>, 2>;
extern const Table kRows;
}  // namespace sobol_detail

/// The coordinates of one Sobol' point in all dimensions, bit-reversed.
struct SobolRow {
  const uint32_t* low = nullptr;
  const uint32_t* high = nullptr;
};

inline SobolRow sobol_row(uint32_t index) {
  return {sobol_detail::kRows[0][index & 255].data(),
          sobol_detail::kRows[1][(index >> 8) & 255].data()};
}

/// A hash in which each bit of the result depends only on the bits of `x` at and below it.
/// Source: Laine & Karras, "Stratified Sampling for Stochastic Transparency", 2011; constants by
/// Vegdahl, "Building a Better LK Hash", 2021.
constexpr uint32_t laine_karras(uint32_t x, uint32_t seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

/// Nested uniform (Owen) scramble of a bit-reversed fraction; the result is in ordinary bit order.
constexpr uint32_t owen_scramble_reversed(uint32_t reversed, uint32_t seed) {
  return reverse_bits(laine_karras(reversed, seed));
}

/// A permutation of the indices below 2^kSobolIndexBits that maps aligned blocks of 2^k indices to
/// aligned blocks of 2^k indices, for every k.
constexpr uint32_t shuffle_index(uint32_t index, uint32_t seed) {
  return reverse_bits(laine_karras(reverse_bits(index), seed)) & ((1u << kSobolIndexBits) - 1);
}

/// The seed of the Owen scramble of a dimension; `key` tells the pixels apart.
[[gnu::always_inline]] constexpr uint32_t scramble_seed(uint32_t key, uint32_t dimension) {
  return mix32(key + 0x9e3779b9u * (dimension + 1));
}

/// The point of a later block of dimensions: each pixel has its own order of them.
[[gnu::always_inline]] constexpr uint32_t shuffled_point(uint32_t index, uint32_t key,
                                                         uint32_t block) {
  return shuffle_index(index, mix32(key ^ (0x85ebca6bu * block)));
}

/// The numbers of kSobolGroup dimensions of a sample, from dimension `first` on, each scrambled by
/// a seed of its own. `key` tells the pixels apart; `row` has the point for these dimensions, in
/// which `first` is dimension first % kSobolDimensions.
void scramble_group(const SobolRow& row, uint32_t key, uint32_t first, float* numbers);

}  // namespace duet
