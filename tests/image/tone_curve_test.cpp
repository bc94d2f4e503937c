#include "image/tone_curve.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace duet;
using doctest::Approx;

namespace {

Spectrum linear_of(const Spectrum& shown) {
  const auto linear = [](float v) {
    return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
  };
  return {linear(shown.r), linear(shown.g), linear(shown.b)};
}

}  // namespace

TEST_CASE("tone curves: greys stay grey, by the values of their formulas") {
  // By hand: (0.18 · 0.2045786 − 0.000090537) / (0.18 · 0.61002222 + 0.238081) = 0.105591.
  const Spectrum aces = linear_of(displayed(Spectrum(0.18f), ToneCurve::aces));
  for (int c = 0; c < 3; ++c) CHECK(aces[c] == Approx(0.105591).epsilon(2e-4));
  // By hand: x = (log2 0.18 + 12.47393) / 16.5 = 0.60606, whose polynomial is 0.4966.
  const Spectrum agx = displayed(Spectrum(0.18f), ToneCurve::agx);
  for (int c = 0; c < 3; ++c) CHECK(agx[c] == Approx(0.4966).epsilon(2e-3));
  const Spectrum plain = linear_of(displayed(Spectrum(0.18f), ToneCurve::srgb));
  for (int c = 0; c < 3; ++c) CHECK(plain[c] == Approx(0.18).epsilon(1e-5));
}

TEST_CASE("tone curves grow, stay within the display and survive what is no number") {
  for (const ToneCurve curve : {ToneCurve::srgb, ToneCurve::aces, ToneCurve::agx}) {
    CAPTURE(kToneCurveNames[size_t(curve)]);
    float last = 0;
    for (float v = 1e-4f; v < 1e9f; v *= 1.1f) {
      const Spectrum c = displayed(Spectrum(v), curve);
      // The polynomial of AgX falls by its last digits at its ends.
      CHECK(c.g >= last - 0.004f);
      CHECK(c.g <= 1);
      last = c.g;
    }
    CHECK(last > 0.95f);
    for (const float v : {-1.0f, NAN, 0.0f}) CHECK(displayed(Spectrum(v), curve).r <= 0.005f);
    CHECK(displayed(Spectrum(INFINITY), curve).r > 0.9f);
  }
  // Bright red keeps its hue with the cut-off, and fades to white with the curves of film.
  const Spectrum red(60, 0.2f, 0.1f);
  CHECK(displayed(red, ToneCurve::srgb).b < 0.4f);
  CHECK(displayed(red, ToneCurve::aces).b > displayed(red, ToneCurve::srgb).b);
  CHECK(displayed(red, ToneCurve::agx).g > 0.4f);
}
