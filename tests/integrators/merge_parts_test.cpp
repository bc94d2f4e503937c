#include "integrators/merge_parts.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "transport/merge_mask.h"

using namespace duet;

namespace {

constexpr int kSide = MergeMask::kSide;

/// A method with the same figures in all parts.
PredictedMethod even(double error, double cost) {
  PredictedMethod p;
  p.error = p.variance = error;
  p.cost = cost;
  const double share = error / (kSide * kSide);
  p.parts.assign(size_t(kSide * kSide), {.variance = share, .error = share});
  return p;
}

void add_error(PredictedMethod& p, int x, int y, double error) {
  p.error += error;
  p.parts[size_t(y * kSide + x)].error += error;
}

}  // namespace

TEST_CASE("photons are merged around the part where they lessen the error, and only there") {
  PredictedMethod without = even(1, 1);
  const PredictedMethod with = even(1, 1.5);
  add_error(without, 5, 9, 10);
  const PartlyMerged m = merge_where_it_pays(without, with);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const bool near = std::abs(x - 5) <= 1 && std::abs(y - 9) <= 1;
      CHECK((m.parts[size_t(y * kSide + x)] != 0) == near);
    }
  CHECK(m.share == doctest::Approx(9.0 / (kSide * kSide)));
  CHECK(m.prediction.error == doctest::Approx(1));
  CHECK(m.prediction.cost == doctest::Approx(1 + 0.5 * m.share));
}

TEST_CASE(
    "photons are merged everywhere where that pays everywhere, and nowhere where it does not") {
  CHECK(merge_where_it_pays(even(2, 1), even(1, 1.5)).share == 1);
  CHECK(merge_where_it_pays(even(1, 1), even(0.9, 1.5)).share == 0);
}

TEST_CASE("photons are merged where nothing else finds the light, whatever it costs") {
  PredictedMethod without = even(1, 1);
  without.parts[0].missing = 1e-3;
  const PartlyMerged m = merge_where_it_pays(without, even(2, 10));
  CHECK(m.parts[0] != 0);
  CHECK(m.share == doctest::Approx(4.0 / (kSide * kSide)));
  CHECK(m.prediction.missing == 0);
}
