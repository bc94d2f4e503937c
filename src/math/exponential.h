// Exponentials and logarithms for inner loops: polynomials without branches or calls, so that loops
// over many points have the same bits as code for one, good to about 2e-7.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace duet {

/// e to the power of x ≤ 88. What would be less than 1.6e-38 is that.
[[gnu::always_inline]] inline float polynomial_exp(float x) {
  // In this order: of NaN comes the bound, which is a number that fits into the integer below.
  const float bounded = std::max(-87.0f, x);
  // Adding 1.5 · 2²³ rounds to the nearest integer, which the last bits then hold.
  constexpr float kRound = 0x1.8p23f;
  const float shifted = bounded * 1.44269504f + kRound, n = shifted - kRound;
  // ln 2 in two parts: the product with the first is exact.
  const float r = (bounded - n * 0x1.62e4p-1f) - n * 1.42860677e-6f;
  // (e^r − 1) / r, minimax for |r| ≤ ln 2 / 2
  const float q =
      1.00000001f +
      r * (0.499999981f +
           r * (0.166665062f + r * (0.0416671364f + r * (0.00836907401f + r * 0.00138888729f))));
  const int32_t exponent = std::bit_cast<int32_t>(shifted) - std::bit_cast<int32_t>(kRound) + 127;
  return (1 + r * q) * std::bit_cast<float>(exponent << 23);
}

/// The natural logarithm of a positive number that is not denormalised.
[[gnu::always_inline]] inline float polynomial_log(float x) {
  const int32_t bits = std::bit_cast<int32_t>(x);
  // The mantissa is to lie between √½ and √2.
  const int32_t exponent = (bits - std::bit_cast<int32_t>(0.70710678f)) >> 23;
  const float f = std::bit_cast<float>(bits - (exponent << 23)) - 1;
  // ln(1 + f) / f, minimax
  const float q =
      0.999999945f +
      f * (-0.500003651f +
           f * (0.333350589f +
                f * (-0.24969909f +
                     f * (0.199001656f +
                          f * (-0.172508301f + f * (0.162225796f - f * 0.101068931f))))));
  return float(exponent) * 0.693147181f + f * q;
}

}  // namespace duet
