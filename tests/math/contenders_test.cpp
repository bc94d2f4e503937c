#include "math/contenders.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace duet;

TEST_CASE("the best is best only if no interval overlaps its own") {
  using List = std::vector<size_t>;
  const Estimate a{1, {0.8, 1.2}}, b{2, {1.5, 2.5}}, c{2.2, {1.9, 2.6}}, d{9, {8, 11}};
  CHECK(contenders({a, b}) == List{1});
  CHECK(contenders({b, a, c}) == List{2, 0});
  CHECK(contenders({a, b, c, d}) == List{3});
  CHECK(contenders({a, b, c, d}, false) == List{0});
  CHECK(contenders({c, b, d}, false) == List{1, 0});
  CHECK(contenders({std::nullopt, a}) == List{1});
  CHECK(contenders({std::nullopt}).empty());
  CHECK(contenders({}).empty());
  // Intervals that touch overlap; one without an end reaches all above its beginning.
  CHECK(contenders({Estimate{1, {0.5, 1.5}}, b}) == List{1, 0});
  CHECK(contenders({a, d, Estimate{INFINITY, {10, INFINITY}}}) == List{2, 1});
}
