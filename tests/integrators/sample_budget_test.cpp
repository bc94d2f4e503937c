// How many samples are expected of a render that something other than their number ends.
#include "integrators/sample_budget.h"

#include <doctest/doctest.h>

using namespace duet;

namespace {

PredictedMethod method(double variance, double cost) {
  PredictedMethod p;
  p.variance = variance, p.cost = cost;
  return p;
}

}  // namespace

TEST_CASE("samples follow from the first limit") {
  const RenderOutlook plain{{100, 50}, 64, 2};
  CHECK(expected_samples(plain, method(1, 1)) == 64);
  RenderOutlook timed = plain;
  timed.spp = 0;
  timed.seconds = 1;  // 2e6 µs for 5,000 pixels
  CHECK(expected_samples(timed, method(1, 4)) == 100);
  timed.threads = 1;
  CHECK(expected_samples(timed, method(1, 4)) == 50);
  timed.spp = 20;
  CHECK(expected_samples(timed, method(1, 4)) == 20);
  RenderOutlook exact = plain;
  exact.spp = 0;
  exact.target_error = 0.1;
  CHECK(expected_samples(exact, method(3, 4)) == 300);
  exact.spp = 200;
  CHECK(expected_samples(exact, method(3, 4)) == 200);
}

TEST_CASE("there is always a sample, and no more than can make a difference") {
  RenderOutlook any{{100, 50}, 0, 2};
  CHECK(expected_samples(any, method(1, 1)) == 1000000);
  any.seconds = 1e-9;
  CHECK(expected_samples(any, method(1, 1)) == 1);
  any.seconds = 1e300;
  CHECK(expected_samples(any, method(1, 0)) == 1000000);
  any.target_error = 0.5;
  CHECK(expected_samples(any, method(0, 1)) == 1);
}
