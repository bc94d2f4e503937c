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
  // The product moves the exponent from a bias of 15 to one of 127, that of denormal numbers, too.
  const float magnitude = std::bit_cast<float>(uint32_t(bits & 0x7fff) << 13) * 0x1p112f;
  return std::bit_cast<float>(std::bit_cast<uint32_t>(magnitude) | uint32_t(bits & 0x8000) << 16);
}

}  // namespace duet
