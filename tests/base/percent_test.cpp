#include "base/percent.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using duet::percent;
using duet::ratio;

TEST_CASE("percentages have three digits and no exponent") {
  CHECK(percent(0) == "0 %");
  CHECK(percent(1) == "100 %");
  CHECK(percent(1.3) == "130 %");
  CHECK(percent(123.456) == "12346 %");
  CHECK(percent(0.123456) == "12.3 %");
  CHECK(percent(0.02) == "2 %");
  CHECK(percent(0.0000123) == "0.00123 %");
  CHECK(percent(0.000012) == "0.0012 %");
  CHECK(percent(0.09999) == "10 %");
  CHECK(percent(0.99999) == "100 %");
  CHECK(percent(-0.0123) == "-1.23 %");
  CHECK(percent(1e-30) == "0 %");
  CHECK(percent(std::numeric_limits<double>::infinity()) == "inf %");
  CHECK(percent(std::nan("")) == "nan %");
}

TEST_CASE("ratios have two digits and no exponent") {
  CHECK(ratio(0) == "0");
  CHECK(ratio(0.01234) == "0.012");
  CHECK(ratio(1) == "1");
  CHECK(ratio(1.26) == "1.3");
  CHECK(ratio(12.6) == "13");
  CHECK(ratio(126.4) == "126");
  CHECK(ratio(123456) == "123456");
  CHECK(ratio(std::numeric_limits<double>::infinity()) == "inf");
}
