#include "math/exponential.h"

#include <doctest/doctest.h>
#include <cmath>
#include <limits>

using namespace duet;

TEST_CASE("exponentials and logarithms are good to single precision") {
  double worst_exp = 0, worst_log = 0;
  for (int i = 0; i <= 175000; ++i) {
    const float x = float(i) / 1000.0f - 87;
    const double exact = std::exp(double(x));
    worst_exp = std::max(worst_exp, std::abs(double(polynomial_exp(x)) - exact) / exact);
  }
  for (int i = -100000; i <= 100000; ++i) {
    const float x = float(std::exp(8e-4 * i));
    const double exact = std::log(double(x));
    worst_log =
        std::max(worst_log, std::abs(double(polynomial_log(x)) - exact) / (1 + std::abs(exact)));
  }
  CHECK(worst_exp < 2e-7);
  CHECK(worst_log < 2e-7);
  CHECK(polynomial_exp(0) == 1);
  CHECK(polynomial_log(1) == 0);
}

TEST_CASE("exponentials of what is far below zero, or no number, are tiny") {
  const float infinity = std::numeric_limits<float>::infinity();
  for (const float x : {-87.5f, -1e9f, -infinity, std::numeric_limits<float>::quiet_NaN()}) {
    CHECK(polynomial_exp(x) > 0);
    CHECK(polynomial_exp(x) < 2e-38f);
  }
}
