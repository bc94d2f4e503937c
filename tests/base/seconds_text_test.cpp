#include "base/seconds_text.h"

#include <doctest/doctest.h>

using namespace duet;

TEST_CASE("durations have the unit that suits them") {
  CHECK(seconds_text(1.24) == "1.2 s");
  CHECK(seconds_text(200) == "3 min 20 s");
  CHECK(seconds_text(3599.6) == "1 h 0 min");
  CHECK(seconds_text(7500) == "2 h 5 min");
}
