// Small integer hashes that turn indices into well mixed bits.
#pragma once

#include <cstdint>

namespace duet {

/// A 64-bit finaliser (Stafford's variant 13 of MurmurHash3's, as in SplitMix64).
constexpr uint64_t mix64(uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

/// A 32-bit finaliser (Wellons' "lowbias32" search result).
constexpr uint32_t mix32(uint32_t x) {
  x = (x ^ (x >> 16)) * 0x7feb352du;
  x = (x ^ (x >> 15)) * 0x846ca68bu;
  return x ^ (x >> 16);
}

constexpr uint64_t hash_combine(uint64_t a, uint64_t b) {
  return mix64(a + 0x9e3779b97f4a7c15ull + mix64(b));
}

/// The upper 24 bits as a float in [0, 1).
constexpr float to_unit_float(uint32_t x) {
  return static_cast<float>(x >> 8) * 0x1p-24f;
}

constexpr uint32_t reverse_bits(uint32_t x) {
  x = __builtin_bswap32(x);
  x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
  x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
  return ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
}

}  // namespace duet
