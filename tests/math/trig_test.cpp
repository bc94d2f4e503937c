#include "math/trig.h"

#include <doctest/doctest.h>

using namespace duet;

TEST_CASE("sines and arc tangents are good to single precision") {
  constexpr double kTurn = 2 * 3.14159265358979323846;
  double worst_sine = 0, worst_angle = 0;
  for (int i = 0; i <= 200000; ++i) {
    const float turns = float(i) / 100000.0f;
    float s, c;
    sincos_turns(turns, s, c);
    const double exact = kTurn * double(turns);
    worst_sine = std::max(
        {worst_sine, std::abs(double(s) - std::sin(exact)), std::abs(double(c) - std::cos(exact))});
    if (turns > 1) continue;
    const double x = 3 * std::cos(exact), y = 3 * std::sin(exact);
    const double angle = std::atan2(double(float(y)), double(float(x))) / kTurn;
    worst_angle = std::max(worst_angle, std::abs(double(atan2_turns(float(y), float(x))) - angle));
  }
  CHECK(worst_sine < 3e-7);
  CHECK(worst_angle < 6e-8);
  CHECK(atan2_turns(0, 0) == 0);
  CHECK(atan2_turns(0, -1) == 0.5f);
  CHECK(atan2_turns(-0.0f, -1) == -0.5f);
  CHECK(atan2_turns(1, 0) == 0.25f);
  CHECK(atan2_turns(1e-20f, 1) == doctest::Approx(1e-20 / kTurn).epsilon(1e-5));
}
