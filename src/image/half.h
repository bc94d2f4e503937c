// Numbers as 16-bit floating point.
#pragma once

#include <bit>
#include <cstdint>

namespace duet {

/// The bits of the nearest IEEE 754 binary16 number; what is too large becomes ±65504, unless it is
/// infinite.
uint16_t half_bits(float value);

/// The number with these bits, which must be finite.
inline float half_value(uint16_t bits) {
  // What is denormal as a half is none as a float. While rendering, denormal floats are zero.
  constexpr uint32_t kSmallestNormal = 0x400, kBiases = (127 - 15) << 23;
  const uint32_t b = bits & 0x7fff;
  const float magnitude =
      b < kSmallestNormal ? float(int(b)) * 0x1p-24f : std::bit_cast<float>((b << 13) + kBiases);
  return std::bit_cast<float>(std::bit_cast<uint32_t>(magnitude) | uint32_t(bits & 0x8000) << 16);
}

}  // namespace duet
