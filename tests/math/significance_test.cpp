// Student's and Welch's tests, against tables.
#include "math/significance.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <vector>

using namespace duet;

TEST_CASE("Student's distribution has its known tails") {
  CHECK(student_p_value(12.7062, 1) == doctest::Approx(0.05).epsilon(1e-4));
  CHECK(student_p_value(2.77645, 4) == doctest::Approx(0.05).epsilon(1e-4));
  CHECK(student_p_value(2.75, 30) == doctest::Approx(0.01).epsilon(1e-3));
  CHECK(student_p_value(0.3, 1.7) == doctest::Approx(0.7968029).epsilon(1e-6));
  CHECK(student_p_value(6, 15) == doctest::Approx(2.4326546e-5).epsilon(1e-6));
  CHECK(student_p_value(-6, 15) == student_p_value(6, 15));
  CHECK(student_p_value(1.959964, 1e6) == doctest::Approx(0.05).epsilon(1e-3));
  CHECK(student_p_value(0, 3) == doctest::Approx(1));
}

TEST_CASE("means and their errors") {
  const MeanEstimate e = estimate_mean(std::vector<double>{1, 2, 3, 6});
  CHECK(e.mean == 3);
  CHECK(e.error2 == doctest::Approx(14.0 / 12));
  CHECK(e.count == 4);
  CHECK(estimate_mean({}).count == 0);
}

TEST_CASE("Welch's test: p-values of equal means are uniform, those of unequal ones small") {
  std::mt19937 generator(1);
  std::normal_distribution<double> noise(0, 1);
  const auto sample = [&](int n, double deviation) {
    std::vector<double> v;
    for (int i = 0; i < n; ++i) v.push_back(5 + deviation * noise(generator));
    return estimate_mean(v);
  };
  int below[2] = {};
  constexpr int kTrials = 20000;
  for (int i = 0; i < kTrials; ++i) {
    const double p = welch_p_value(sample(8, 1), sample(16, 3));
    below[0] += p < 0.01, below[1] += p < 0.5;
  }
  CHECK(std::abs(below[0] - 0.01 * kTrials) < 70);
  CHECK(std::abs(below[1] - 0.5 * kTrials) < 350);
  const MeanEstimate a{1, 1e-4, 16}, b{1.1, 1e-4, 16};
  CHECK(welch_p_value(a, b) < 1e-5);
  CHECK(welch_p_value(a, b, 0.09) ==
        doctest::Approx(welch_p_value({0, 1e-4, 16}, {0.01, 1e-4, 16})));
  CHECK(welch_p_value(a, b, 0.2) == 1);
  CHECK(welch_p_value({1, 0, 1}, {1, 0, 1}) == 1);
  CHECK(welch_p_value({1, 0, 1}, {1.5, 0, 1}) == 0);
  CHECK(welch_p_value({NAN, 1, 4}, a) == 0);
  CHECK(welch_p_value({1, 1e-4, 16}, {1.1, 0, 0}) ==
        doctest::Approx(student_p_value(10, 15)).epsilon(1e-6));
}

TEST_CASE("levels of many tests") {
  CHECK(1 - std::pow(1 - sidak_level(0.01, 64), 64) == doctest::Approx(0.01));
  CHECK(sidak_level(0.05, 1) == doctest::Approx(0.05));
}
