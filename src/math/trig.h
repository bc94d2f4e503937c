// Trigonometry for inner loops: polynomials without branches or calls, good to about 2e-7.
#pragma once

#include "math/vector.h"

namespace duet {

/// Sine and cosine of angles between −π/4 and π/4, to about one unit in the last place.
inline void small_sincos(float x, float& sine, float& cosine) {
  const float x2 = x * x;
  sine = x * (1 + x2 * (-1.6666654611e-1f + x2 * (8.3321608736e-3f - 1.9515295891e-4f * x2)));
  cosine = 1 - 0.5f * x2 +
           x2 * x2 *
               (4.166664568298827e-2f + x2 * (-1.388731625493765e-3f + 2.443315711809948e-5f * x2));
}

/// Sine and cosine of `turns` full circles; 0 ≤ turns ≤ 2.
inline void sincos_turns(float turns, float& sine, float& cosine) {
  const int quarter = int(4 * turns + 0.5f);
  float s, c;
  small_sincos((turns - 0.25f * float(quarter)) * (2 * kPi), s, c);
  const bool swap = quarter & 1;
  sine = swap ? c : s;
  cosine = swap ? s : c;
  sine = quarter & 2 ? -sine : sine;
  cosine = (quarter + 1) & 2 ? -cosine : cosine;
}

/// The angle of the vector (x, y) in turns, from −1/2 to 1/2; of the zero vector 0.
inline float atan2_turns(float y, float x) {
  const float ax = std::abs(x), ay = std::abs(y);
  const float t = std::min(ax, ay) / std::max(std::max(ax, ay), 1e-37f), t2 = t * t;
  // arctan t / t on [0, 1], minimax in t²
  const float p = 0.9999993356f +
                  t2 * (-0.3332986076f +
                        t2 * (0.1994656536f +
                              t2 * (-0.1390862806f +
                                    t2 * (0.0964219347f +
                                          t2 * (-0.05591227343f +
                                                t2 * (0.02186292046f - 0.004054556749f * t2))))));
  float a = t * p * (0.5f * kInvPi);
  a = ay > ax ? 0.25f - a : a;
  a = x < 0 ? 0.5f - a : a;
  return std::copysign(a, y);
}

}  // namespace duet
