#include "curves/curve_file.h"

#include <doctest/doctest.h>

#include <cstring>

using namespace duet;

namespace {

CurveSet parse(const std::string& text, CurveKind kind) {
  ByteReader in("c.txt", {reinterpret_cast<const uint8_t*>(text.data()), text.size()});
  return parse_curves(in, kind);
}
CurveSet parse_hairs(const std::string& text) {
  ByteReader in("h.hair", {reinterpret_cast<const uint8_t*>(text.data()), text.size()});
  return parse_hair(in, 0.5f);
}
template <class F>
std::string error_of(const F& f) {
  try {
    f();
  } catch (const ReadError& e) {
    return e.what();
  }
  return "";
}

const char* const kTwoCurves =
    "-1 0.1 0.1 0.5\n 1.0\t1.4 +1.2 5e-1 ignored\r\n\n\n-1 5 2.2 1\n-2.3 4 2.3 2\n4 1 2 5";

}  // namespace

TEST_SUITE("curve files") {
  TEST_CASE("points, radii and where curves end") {
    const CurveSet c = parse(kTwoCurves, CurveKind::linear);
    REQUIRE(c.points.size() == 5);
    CHECK(c.points[1] == TubePoint{{1.0f, 1.4f, 1.2f}, 0.5f});
    CHECK(c.points[4] == TubePoint{{4, 1, 2}, 5});
    CHECK(c.segments == std::vector<uint32_t>{0, 2, 3});
    CHECK(c.outside_only);
  }

  TEST_CASE("B-splines need four points per segment") {
    std::string text;
    for (int i = 0; i < 6; ++i) text += std::to_string(i) + " 0 0 0.1\n";
    CHECK(parse(text, CurveKind::bspline).segments == std::vector<uint32_t>{0, 1, 2});
  }

  TEST_CASE("errors name the line") {
    const auto linear = [](const char* text) {
      return error_of([&] { parse(text, CurveKind::linear); });
    };
    CHECK(linear("0 0 0 1\n0 0 x 1\n") == "c.txt:2: \"x\" is not a number (z)");
    CHECK(linear("0 0 0 1\n0 0 0\n") == "c.txt:2: the line ends before the radius");
    CHECK(linear("0 0 0 1\n0 0 0 -1\n") == "c.txt:2: the radius -1 is negative");
    CHECK(linear("0 0 nan 1\n") == "c.txt:1: z is not finite");
    CHECK(linear("0 1e99 0 1\n") == "c.txt:1: y is not finite");
    CHECK(linear("0 0 0 1\n\n0 0 0 1\n0 1 0 1\n") ==
          "c.txt:2: a curve ends here that has 1 point: it needs at least 2");
    CHECK(linear("\n \n") == "c.txt: has no points");
    CHECK(error_of([] { parse(kTwoCurves, CurveKind::bspline); }) ==
          "c.txt:3: a curve ends here that has 2 points: it needs at least 4");
  }

  TEST_CASE("hair of 0.6 as text") {
    const CurveSet h = parse_hairs("0 0 0\n1 0 0\n1 1 0\n\n5 5 5\n\n2 2 2\n3 3 3\n");
    REQUIRE(h.points.size() == 5);
    CHECK(h.points[3] == TubePoint{{2, 2, 2}, 0.5f});
    CHECK(h.segments == std::vector<uint32_t>{0, 1, 3});
    CHECK_FALSE(h.outside_only);
  }

  TEST_CASE("binary hair of 0.6") {
    std::string text = "BINARY_HAIR";
    const auto add = [&](auto value) {
      char bytes[4];
      std::memcpy(bytes, &value, 4);
      text.append(bytes, 4);
    };
    add(uint32_t(4));
    for (int i = 0; i < 4; ++i) {
      if (i == 2) add(INFINITY);
      for (int k = 0; k < 3; ++k) add(float(3 * i + k));
    }
    const CurveSet h = parse_hairs(text);
    REQUIRE(h.points.size() == 4);
    CHECK(h.points[2] == TubePoint{{6, 7, 8}, 0.5f});
    CHECK(h.segments == std::vector<uint32_t>{0, 2});
    CHECK(error_of([&] { parse_hairs(text.substr(0, text.size() - 1)); }) ==
          "h.hair: the file ends in the middle of its points");
  }
}
