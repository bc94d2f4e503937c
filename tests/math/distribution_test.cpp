#include "math/distribution.h"

#include <doctest/doctest.h>

#include <array>

#include "support/statistics.h"

using namespace duet;

TEST_CASE("a discrete distribution picks what has weight, as often as its probability says") {
  const std::array<float, 6> weights{0, 2, 0, 1, 5, 0};
  const DiscreteDistribution d(weights);
  CHECK(d.sum() == 8);
  std::vector<double> observed(6), expected(6);
  const int n = 100000;
  for (int i = 0; i < n; ++i) {
    const float u = (float(i) + 0.5f) / n;
    const auto pick = d.sample(u);
    observed[pick.index] += 1;
    CHECK(pick.probability == d.probability(pick.index));
    CHECK(pick.remapped >= 0);
    CHECK(pick.remapped < 1);
  }
  for (uint32_t i = 0; i < 6; ++i) {
    CHECK(d.probability(i) == doctest::Approx(weights[i] / 8));
    CHECK(observed[i] == doctest::Approx(n * weights[i] / 8).epsilon(1e-3));
  }
  CHECK(d.sample(0).index == 1);
  CHECK(d.sample(0x1.fffffep-1f).index == 4);
}

TEST_CASE("weights that are all zero mean equal chances") {
  const std::array<float, 4> weights{};
  const DiscreteDistribution d(weights);
  for (uint32_t i = 0; i < 4; ++i) CHECK(d.probability(i) == doctest::Approx(0.25));
}

TEST_CASE("the bilinear distribution samples its own density") {
  std::vector<float> nodes;
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 7; ++x)
      nodes.push_back(float((x * 7 + y * 3) % 5) * (y == 2 ? 0.0f : 1.0f));
  const BilinearDistribution d(nodes, 7, 5);
  const auto result = test::chi2_square(
      [&](Point2f u, Point2f& p) {
        const auto s = d.sample(u);
        CHECK(s.density == doctest::Approx(d.density(s.position)).epsilon(1e-3));
        p = s.position;
        return true;
      },
      [&](Point2f p) { return double(d.density(p)); }, {.nx = 42, .ny = 20});
  CHECK_MESSAGE(result.pass, result.message);
}

TEST_CASE("the bilinear distribution of constant nodes is uniform") {
  const BilinearDistribution d(std::vector<float>(6, 3.0f), 3, 2);
  CHECK(d.integral() == doctest::Approx(3));
  CHECK(d.density({0.3f, 0.9f}) == doctest::Approx(1));
  CHECK(d.sample({0.25f, 0.75f}).position.x == doctest::Approx(0.25));
}
