#include "evaluate/raw/slices.h"

#include <doctest/doctest.h>

using namespace duet;

TEST_CASE("slices that lack samples are found, with what they lack") {
  SampleIntervals samples;
  CHECK(incomplete_slices(samples, 10, 3).size() == 3);
  // 0:3, 3:6 and 6:10.
  samples.add({0, 3});
  samples.add({7, 9});
  const auto found = incomplete_slices(samples, 10, 3);
  REQUIRE(found.size() == 2);
  CHECK(found[0].number == 2);
  CHECK(found[0].missing == std::vector<SampleInterval>{{3, 6}});
  CHECK(found[1].number == 3);
  CHECK(found[1].missing == std::vector<SampleInterval>{{6, 7}, {9, 10}});
  samples.add({3, 7});
  samples.add({9, 10});
  CHECK(incomplete_slices(samples, 10, 3).empty());
}
