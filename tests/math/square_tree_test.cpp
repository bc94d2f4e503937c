#include "math/square_tree.h"

#include <doctest/doctest.h>

#include <cmath>

#include "math/sampler.h"
#include "math/warp.h"
#include "support/statistics.h"

using namespace duet;

namespace {

/// Half of the weight in a small square, the other half in a quarter of the whole.
SquareTree uneven_tree(float uniform) {
  std::vector<SquareTree::Record> records;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 40; ++j) {
      const float x = (float(i) + 0.5f) / 40, y = (float(j) + 0.5f) / 40;
      records.push_back({{0.375f + 0.0625f * x, 0.6875f + 0.0625f * y}, 3});
      records.push_back({{0.5f * x, 0.5f * y}, 3});
    }
  return {records, uniform};
}

}  // namespace

TEST_CASE("a square tree samples its density, and says which that is") {
  const SquareTree tree = uneven_tree(0.25f);
  constexpr int n = 400000, side = 32;
  std::vector<double> observed(side * side), expected(side * side);
  Sampler sampler(SampleSequence::independent, 1, 0, 0);
  for (int i = 0; i < n; ++i) {
    sampler.start_sample(uint32_t(i));
    float density;
    const Point2f p = tree.sample(sampler.next_2d(), density);
    REQUIRE((p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1));
    REQUIRE(density == doctest::Approx(tree.density(p)).epsilon(1e-6));
    observed[size_t(int(p.y * side) * side + int(p.x * side))] += 1;
  }
  double sum = 0;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      // No leaf is smaller than a part of these cells, of which all have one density.
      const float d = tree.density({(float(i) + 0.5f) / side, (float(j) + 0.5f) / side});
      expected[size_t(j * side + i)] = double(d) / (side * side) * n;
      sum += double(d) / (side * side);
    }
  CHECK(sum == doctest::Approx(1).epsilon(1e-5));
  const auto result = test::chi2_test(observed, expected, 1e-3);
  CHECK_MESSAGE(result.pass, result.message);
}

TEST_CASE("a square tree follows the weights, and leaves the uniform share everywhere") {
  const SquareTree tree = uneven_tree(0.25f);
  // 3/8 of the mass in 1/256 of the square, and 3/8 in a quarter.
  CHECK(tree.density({0.4f, 0.72f}) == doctest::Approx(0.25 + 0.375 * 256).epsilon(1e-3));
  CHECK(tree.density({0.2f, 0.3f}) == doctest::Approx(0.25 + 0.375 * 4).epsilon(0.02));
  CHECK(tree.density({0.9f, 0.1f}) == doctest::Approx(0.25).epsilon(1e-3));
}

TEST_CASE("a square tree without records, or with too few, is uniform") {
  std::vector<SquareTree::Record> few{{{0.1f, 0.1f}, 1}}, none;
  for (const SquareTree& tree : {SquareTree(), SquareTree(few, 0.5f), SquareTree(none, 0.5f)}) {
    float density;
    const Point2f p = tree.sample({0.3f, 0.8f}, density);
    CHECK(p.x == 0.3f);
    CHECK(p.y == 0.8f);
    CHECK(density == 1);
    CHECK(tree.density({0.9f, 0.9f}) == 1);
  }
}

TEST_CASE("the map from the square to the disk is undone") {
  for (int i = 0; i < 64; ++i)
    for (int j = 0; j < 64; ++j) {
      const Point2f u{(float(i) + 0.5f) / 64, (float(j) + 0.5f) / 64};
      const Point2f back = disk_to_square(square_to_disk(u));
      CHECK(std::abs(back.x - u.x) < 1e-5f);
      CHECK(std::abs(back.y - u.y) < 1e-5f);
    }
  CHECK(disk_to_square({0, 0}).x == 0.5f);
}
