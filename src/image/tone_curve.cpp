#include "image/tone_curve.h"

#include <algorithm>
#include <cmath>

namespace duet {

namespace {

/// Rows times a column.
Spectrum product(const float (&m)[3][3], const Spectrum& c) {
  return {m[0][0] * c.r + m[0][1] * c.g + m[0][2] * c.b,
          m[1][0] * c.r + m[1][1] * c.g + m[1][2] * c.b,
          m[2][0] * c.r + m[2][1] * c.g + m[2][2] * c.b};
}

template <class F>
Spectrum each(const Spectrum& c, const F& f) {
  return {f(c.r), f(c.g), f(c.b)};
}

/// Linear colours of the display.
Spectrum aces(const Spectrum& linear) {
  // To the primaries of ACES with its desaturation, and from them.
  constexpr float kIn[3][3] = {{0.59719f, 0.35458f, 0.04823f},
                               {0.07600f, 0.90834f, 0.01566f},
                               {0.02840f, 0.13383f, 0.83777f}};
  constexpr float kOut[3][3] = {{1.60475f, -0.53108f, -0.07367f},
                                {-0.10208f, 1.10813f, -0.00605f},
                                {-0.00327f, -0.07276f, 1.07602f}};
  const auto fit = [](float v) {
    // The ratio of two parabolas, whose limit is 1 / 0.983729; beyond it floats overflow.
    v = std::min(v, 1e6f);
    return (v * (v + 0.0245786f) - 0.000090537f) / (v * (0.983729f * v + 0.4329510f) + 0.238081f);
  };
  return product(kOut, each(product(kIn, linear), fit));
}

/// Display-encoded colours.
Spectrum agx(const Spectrum& linear) {
  constexpr float kIn[3][3] = {{0.842479062f, 0.0784335999f, 0.0792237451f},
                               {0.0423282422f, 0.878468636f, 0.0791661274f},
                               {0.0423756549f, 0.0784336f, 0.879142973f}};
  constexpr float kOut[3][3] = {{1.19687900f, -0.0980208811f, -0.0990297440f},
                                {-0.0528968517f, 1.15190312f, -0.0989611768f},
                                {-0.0529716355f, -0.0980434501f, 1.15107367f}};
  const auto curve = [](float v) {
    constexpr float kDarkest = -12.47393f, kBrightest = 4.026069f;  // stops
    const float stops = std::clamp(std::log2(std::max(v, 1e-10f)), kDarkest, kBrightest);
    const float x = (stops - kDarkest) / (kBrightest - kDarkest), x2 = x * x, x4 = x2 * x2;
    return 15.5f * x4 * x2 - 40.14f * x4 * x + 31.96f * x4 - 6.868f * x2 * x + 0.4298f * x2 +
           0.1191f * x - 0.00232f;
  };
  return product(kOut, each(product(kIn, linear), curve));
}

float srgb_encoded(float v) {
  return v > 0 ? linear_to_srgb(std::min(v, 1.0f)) : 0;
}

}  // namespace

std::optional<ToneCurve> tone_curve_of(std::string_view name) {
  const auto found = std::find(std::begin(kToneCurveNames), std::end(kToneCurveNames), name);
  if (found == std::end(kToneCurveNames)) return std::nullopt;
  return ToneCurve(found - std::begin(kToneCurveNames));
}

Spectrum displayed(const Spectrum& linear, ToneCurve curve) {
  // Written so that NaN becomes black.
  const Spectrum c = each(linear, [](float v) { return v > 0 ? v : 0.0f; });
  if (curve == ToneCurve::agx)
    return each(agx(c), [](float v) { return v > 0 ? std::min(v, 1.0f) : 0.0f; });
  return each(curve == ToneCurve::aces ? aces(c) : c, srgb_encoded);
}

}  // namespace duet
