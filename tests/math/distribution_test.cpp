#include "math/distribution.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

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
    const auto pick = d.sample(u, {});
    observed[pick.index] += 1;
    CHECK(pick.probability == d.probability(pick.index));
    CHECK(pick.remapped >= 0);
    CHECK(pick.remapped < 1);
  }
  for (uint32_t i = 0; i < 6; ++i) {
    CHECK(d.probability(i) == doctest::Approx(weights[i] / 8));
    CHECK(observed[i] == doctest::Approx(n * weights[i] / 8).epsilon(1e-3));
  }
  CHECK(d.sample(0, {}).index == 1);
  CHECK(d.sample(0x1.fffffep-1f, {}).index == 4);
}

TEST_CASE("weights that are all zero mean equal chances") {
  const std::array<float, 4> weights{};
  const DiscreteDistribution d(weights);
  for (uint32_t i = 0; i < 4; ++i) CHECK(d.probability(i) == doctest::Approx(0.25));
}

TEST_CASE("the guide finds the interval of every variate, however uneven the weights") {
  std::vector<float> weights;
  for (int i = 0; i < 1000; ++i)
    weights.push_back(i % 3 == 0 ? 0.0f : i == 500 ? 1e6f : std::exp(float(i % 17)));
  const DiscreteDistribution d(weights);
  std::vector<float> cdf(1, 0.0f);
  for (uint32_t i = 0; i < 1000; ++i) cdf.push_back(cdf.back() + d.probability(i));
  for (uint32_t i = 0; i < (1u << 24); i += 97) {
    const float u = float(i) * 0x1p-24f;
    const auto pick = d.sample(u, {});
    REQUIRE(pick.probability > 0);
    REQUIRE(weights[pick.index] > 0);
    REQUIRE(cdf[pick.index] <= u + 1e-5f);
    REQUIRE(u <= cdf[pick.index + 1] + 1e-5f);
  }
}

// A variate of 24 bits could pick every second of these at most.
TEST_CASE("a distribution of 2^25 weights picks each as often as its probability says") {
  constexpr uint32_t n = 1u << 25;
  const auto weight = [](uint32_t i) { return i % 5 == 3 ? 0.0f : float(1 + i % 3); };
  std::vector<float> weights(n);
  for (uint32_t i = 0; i < n; ++i) weights[i] = weight(i);
  const DiscreteDistribution d(weights);
  uint32_t wrong = 0;
  for (uint32_t i = 0; i < n; ++i)
    wrong += !(std::abs(double(d.probability(i)) * d.sum() - double(weights[i])) <=
               1e-4 * double(weights[i]));
  CHECK(wrong == 0);
  // Bins of equal remainders have members all over the table, and neighbours in different bins.
  constexpr uint32_t kBins = 4096;
  std::vector<double> observed(kBins), expected(kBins), rest(64);
  for (uint32_t i = 0; i < n; ++i) expected[i % kBins] += double(weights[i]);
  constexpr uint32_t kSamples = 1u << 22;
  for (uint32_t k = 0; k < kSamples; ++k) {
    const uint64_t a = mix64(k), b = mix64(a);
    const auto pick = d.sample(to_unit_float(uint32_t(a)),
                               {to_unit_float(uint32_t(a >> 32)), to_unit_float(uint32_t(b))});
    REQUIRE(pick.probability == d.probability(pick.index));
    REQUIRE(pick.probability > 0);
    observed[pick.index % kBins] += 1;
    rest[size_t(pick.remapped * 64)] += 1;
  }
  for (double& e : expected) e *= kSamples / d.sum();
  const auto picked = test::chi2_test(observed, expected, 0.01);
  CHECK_MESSAGE(picked.pass, picked.message);
  const auto uniform = test::chi2_test(rest, std::vector<double>(64, double(kSamples) / 64), 0.01);
  CHECK_MESSAGE(uniform.pass, uniform.message);
}

TEST_CASE("each of 2^25 equal weights can be picked") {
  constexpr uint32_t n = 1u << 25;
  const DiscreteDistribution d(std::vector<float>(n, 0.3f));
  // Sixteen variates for each pair, one of which stays without with a probability of 2^-16.
  std::vector<uint8_t> met(n);
  for (uint32_t k = 0; k < 8; ++k)
    for (uint32_t i = 0; i < n; ++i) {
      const uint64_t random = mix64(uint64_t(k) << 32 | i);
      ++met[d.sample(float(i / 2) * 0x1p-24f,
                     {to_unit_float(uint32_t(random)), to_unit_float(uint32_t(random >> 32))})
                .index];
    }
  CHECK(double(std::count(met.begin(), met.end(), 0)) ==
        doctest::Approx(n * 0x1p-16).epsilon(0.25));
}

TEST_CASE("the bilinear distribution samples its own density") {
  const auto node = [](int x, int y) {
    return float((x * 7 + y * 3) % 5) * (y == 2 ? 0.0f : 1.0f);
  };
  const BilinearDistribution d(7, 5, node);
  const auto density = [&](Point2f p) {
    const float x = std::min(p.x * 6, 5.99999f), y = std::min(p.y * 4, 3.99999f);
    return double(d.density(int(x), int(y), x - float(int(x)), y - float(int(y)), node));
  };
  const auto result = test::chi2_square(
      [&](Point2f u, Point2f& p) {
        const auto s = d.sample(u, node);
        p = {(float(s.x) + s.dx) / 6, (float(s.y) + s.dy) / 4};
        CHECK(s.density == doctest::Approx(d.density(s.x, s.y, s.dx, s.dy, node)).epsilon(1e-5));
        return true;
      },
      density, {.nx = 42, .ny = 20});
  CHECK_MESSAGE(result.pass, result.message);
}

TEST_CASE("the bilinear distribution of equal nodes is uniform, even of zeros") {
  for (const float value : {3.0f, 0.0f}) {
    const auto node = [&](int, int) { return value; };
    const BilinearDistribution d(3, 2, node);
    CHECK(d.integral() == doctest::Approx(value));
    CHECK(d.density(1, 0, 0.3f, 0.9f, node) == doctest::Approx(1));
    const auto s = d.sample({0.125f, 0.75f}, node);
    CHECK(s.x == 0);
    CHECK(s.dx == doctest::Approx(0.25));
    CHECK(s.dy == doctest::Approx(0.75));
    CHECK(s.density == doctest::Approx(1));
  }
}
