#include "image/resample.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace duet;

namespace {

const FilterDescription kLanczos{.kind = FilterKind::lanczos, .lobes = 2};

/// By the definition: every pixel of the grid, continued far beyond its edges, by its weight.
float oracle(const std::vector<float>& values, int width, int height, int new_width, int new_height,
             int x, int y, const FilterDescription& filter) {
  const double cx = (x + 0.5) / new_width * width, cy = (y + 0.5) / new_height * height;
  double sum = 0, weights = 0;
  for (int j = -9; j < height + 9; ++j)
    for (int i = -9; i < width + 9; ++i) {
      const double w =
          evaluate_filter(filter, i + 0.5 - cx) * evaluate_filter(filter, j + 0.5 - cy);
      weights += w;
      sum +=
          w *
          double(
              values[size_t(std::clamp(j, 0, height - 1) * width + std::clamp(i, 0, width - 1))]);
    }
  return float(sum / weights);
}

}  // namespace

TEST_CASE("resample: by hand, with a tent") {
  const FilterDescription tent{.kind = FilterKind::tent, .radius = 1};
  const std::vector<float> two = enlarge({0, 6}, 2, 1, 3, 1, tent);
  REQUIRE(two.size() == 3);
  // The middles of thirds lie at 1/3, 1 and 5/3 of a pixel; those of the pixels at 1/2 and 3/2.
  CHECK(two[0] == doctest::Approx(0));
  CHECK(two[1] == doctest::Approx(3));
  CHECK(two[2] == doctest::Approx(6));
  const std::vector<float> four = enlarge({0, 8}, 2, 1, 4, 1, tent);
  CHECK(four[1] == doctest::Approx(2));
  CHECK(enlarge({1, 5, 2}, 1, 3, 1, 3, tent) == std::vector<float>{1, 5, 2});
}

TEST_CASE("resample: all filters, along both axes, beside the definition") {
  std::mt19937 generator(1);
  std::uniform_real_distribution<float> uniform(-1, 1);
  std::vector<float> values(6 * 3);
  for (float& v : values) v = uniform(generator);
  for (const FilterDescription& filter :
       {kLanczos, FilterDescription{.kind = FilterKind::mitchell},
        FilterDescription{.kind = FilterKind::gaussian, .stddev = 0.7}}) {
    const std::vector<float> large = enlarge(values, 6, 3, 9, 5, filter);
    REQUIRE(large.size() == 45);
    for (int y = 0; y < 5; ++y)
      for (int x = 0; x < 9; ++x)
        CHECK(large[size_t(y * 9 + x)] ==
              doctest::Approx(oracle(values, 6, 3, 9, 5, x, y, filter)).epsilon(1e-5));
  }
}

TEST_CASE("resample: one number, and filters that reach no pixel") {
  for (const float v : enlarge({0.25f}, 1, 1, 2, 2, kLanczos)) CHECK(v == 0.25f);
  const FilterDescription thin{.kind = FilterKind::box, .radius = 0.01};
  CHECK(enlarge({1, 2}, 2, 1, 4, 1, thin) == std::vector<float>{1, 1, 2, 2});
}
