// Numbers of 16 bits.
#include "image/half.h"

#include <doctest/doctest.h>

#include "base/parallel.h"

using namespace duet;

TEST_CASE("each finite half is the number that its bits mean, and comes back") {
  CHECK(half_value(0x3c00) == 1);
  CHECK(half_value(0xc500) == -5);
  CHECK(half_value(0x7bff) == 65504);
  CHECK(half_value(0x0001) == 0x1p-24f);
  CHECK(half_value(0x03ff) == 1023 * 0x1p-24f);
  CHECK(half_value(0x0400) == 0x1p-14f);
  // As while rendering, when denormal floats are zero.
  uint32_t wrong = 0;
  parallel_for(1, 1, [&](size_t) {
    for (uint32_t bits = 0; bits < 0x10000; ++bits) {
      constexpr uint32_t kExponent = 0x7c00;
      if ((bits & kExponent) == kExponent) continue;
      if (half_bits(half_value(uint16_t(bits))) != bits) ++wrong;
    }
  });
  CHECK(wrong == 0);
}
