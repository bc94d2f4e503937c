// Slopes of curves, and whether their intervals are what they say.
#include "math/slope.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

using namespace duet;

namespace {

constexpr size_t kParts = 64;

/// The mean square error of running means of n = 1, 2, 4, … samples, in each of the parts 16 pixels
/// with noise of their own; `bias` is added to all.
std::vector<CurvePoint> running_means(unsigned seed, int points, double bias = 0) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> noise(0, 1);
  constexpr size_t pixels = 16;
  std::vector<double> sums(kParts * pixels);
  std::vector<CurvePoint> curve;
  int n = 0;
  for (int k = 0; k < points; ++k) {
    for (const int target = 1 << k; n < target; ++n)
      for (double& s : sums) s += noise(generator);
    CurvePoint p{double(n), std::vector<double>(kParts), std::vector<double>(kParts, pixels)};
    for (size_t i = 0; i < sums.size(); ++i) p.sums[i / pixels] += std::pow(sums[i] / n + bias, 2);
    curve.push_back(p);
  }
  return curve;
}

}  // namespace

TEST_CASE("a weighted line goes where the weights are") {
  const Line exact = fit_line({1, 2, 4}, {5, 7, 11}, {1, 2, 3});
  CHECK(exact.slope == doctest::Approx(2));
  CHECK(exact.intercept == doctest::Approx(3));
  // The third point has no weight.
  const Line two = fit_line({0, 1, 2}, {0, 1, 100}, {1, 1, 0});
  CHECK(two.slope == doctest::Approx(1));
  // Least squares by hand: x = 0, 1, 2, y = 0, 0, 3.
  const Line three = fit_line({0, 1, 2}, {0, 0, 3}, {1, 1, 1});
  CHECK(three.slope == doctest::Approx(1.5));
  CHECK(three.intercept == doctest::Approx(-0.5));
}

TEST_CASE("running means of independent samples have the slope -1/2, within their interval") {
  int covered = 0;
  double width = 0;
  constexpr int runs = 40;
  for (unsigned seed = 0; seed < runs; ++seed) {
    const CurveFit fit = fit_curve(running_means(seed, 8));
    REQUIRE(fit.slope);
    CHECK(fit.slope->slope == doctest::Approx(-0.5).epsilon(0.1));
    covered += fit.slope->slope_95.low < -0.5 && fit.slope->slope_95.high > -0.5;
    width += (fit.slope->slope_95.high - fit.slope->slope_95.low) / runs;
    CHECK(std::exp(fit.slope->intercept) == doctest::Approx(1).epsilon(0.1));
  }
  // 38 are expected; below 33 or at 40 with a width as large as this has a probability of 1 %.
  CHECK(covered >= 33);
  CHECK(width < 0.06);
  CHECK(width > 0.01);
}

TEST_CASE("the intervals of single values hold them") {
  int covered = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const CurveFit fit = fit_curve(running_means(seed + 1000, 3));
    covered += fit.value_95[2].low < 0.25 && fit.value_95[2].high > 0.25;
  }
  CHECK(covered >= 51);  // of 57 expected
}

TEST_CASE("a bias flattens the slope") {
  const CurveFit fit = fit_curve(running_means(1, 8, 0.3));
  REQUIRE(fit.slope);
  CHECK(fit.slope->slope > -0.3);
}

TEST_CASE("curves without a slope") {
  CHECK(fit_curve({}).value_95.empty());
  CHECK_FALSE(fit_curve(running_means(1, 2)).slope);
  // Three points that are too near to one another.
  std::vector<CurvePoint> near = running_means(1, 3);
  near[0].x = 2, near[1].x = 3, near[2].x = 4;
  CHECK_FALSE(fit_curve(near).slope);
  // Below zero there is no logarithm; what is left are two points.
  std::vector<CurvePoint> negative = running_means(1, 3);
  for (double& s : negative[2].sums) s = -s;
  const CurveFit fit = fit_curve(negative);
  CHECK_FALSE(fit.slope);
  CHECK(fit.value_95[2].high < 0);
}
