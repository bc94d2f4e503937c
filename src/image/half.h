// Numbers as 16-bit floating point.
#pragma once

#include <cstdint>

namespace duet {

/// The bits of the nearest IEEE 754 binary16 number; what is too large becomes ±65504, unless it is
/// infinite.
uint16_t half_bits(float value);

}  // namespace duet
