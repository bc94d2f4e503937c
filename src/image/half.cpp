#include "image/half.h"

#include <half.h>

#include <algorithm>
#include <cmath>

namespace duet {

uint16_t half_bits(float value) {
  if (std::isfinite(value)) value = std::clamp(value, -65504.0f, 65504.0f);
  return Imath::half(value).bits();
}

}  // namespace duet
