// FLIP against the values of its authors' program.
#include "image/flip.h"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

using namespace duet;

namespace {

constexpr int kWidth = 48, kHeight = 40;

/// A reference of many colours, or the same with noise, a cast of blue and one bright pixel.
Image pattern(float scale, bool with_errors) {
  Image image(kWidth, kHeight, {"R", "G", "B"});
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      float* p = image.pixel(x, y);
      p[0] = scale * float((x * 7 + y * 3) % 32 + 1) / 40;
      p[1] = scale * float((x * x + 5 * y) % 48 + 2) / 56;
      p[2] = scale * float((x * y + 11) % 64 + 3) / 80;
      if (!with_errors) continue;
      const int n = (x * 131 + y * 71 + (x * y) % 17) % 29;
      p[0] *= float(86 + n) / 100;
      p[1] *= float(110 - n) / 100;
      if ((x / 8 + y / 8) % 5 == 0) p[2] *= 0.5f;
      if (x == 20 && y == 12) p[0] = p[1] = p[2] = scale;
    }
  return image;
}

/// The upper left quarter or so 400 times brighter.
Image lit(Image image) {
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 24; ++x)
      for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] *= 400;
  return image;
}

Image plain(float r, float g, float b) {
  Image image(8, 8, {"R", "G", "B"});
  for (int i = 0; i < 64; ++i) {
    float* p = image.pixel(i % 8, i / 8);
    p[0] = r, p[1] = g, p[2] = b;
  }
  return image;
}

float at(const FlipResult& r, int x, int y) {
  return r.map[size_t(y * kWidth + x)];
}

doctest::Approx near(double v) {
  return doctest::Approx(v).epsilon(1e-4);
}

}  // namespace

// The numbers of these three cases come from the Python package flip-evaluator 1.7 (NVIDIA), given
// the same images as linear values.
TEST_CASE("LDR-FLIP has the values of its authors' program") {
  const FlipResult r = ldr_flip(pattern(1, true), pattern(1, false));
  CHECK(r.mean == near(0.1830611));
  CHECK(at(r, 0, 0) == near(0.439279));
  CHECK(at(r, 20, 12) == near(0.214036));
  CHECK(at(r, 47, 39) == near(0.087172));
  CHECK(ldr_flip(plain(1, 1, 1), plain(0, 0, 0)).mean == near(0.9673882));
  CHECK(ldr_flip(plain(0, 0, 1), plain(0, 1, 0)).mean == near(1));
}

TEST_CASE("HDR-FLIP has the values of its authors' program") {
  const auto e = flip_exposures(pattern(8, false));
  REQUIRE(e);
  CHECK(e->start == near(-1.6761485));
  CHECK(e->stop == near(-0.7447564));
  CHECK(e->count == 2);
  const auto r = hdr_flip(pattern(8, true), pattern(8, false));
  REQUIRE(r);
  CHECK(r->mean == near(0.1441753));
  CHECK(at(*r, 0, 0) == near(0.552002));
  CHECK(at(*r, 20, 12) == near(0.102902));
  CHECK(at(*r, 47, 39) == near(0.046582));
}

TEST_CASE("HDR-FLIP of many exposures has the values of its authors' program") {
  const Image reference = lit(pattern(0.05f, false)), image = lit(pattern(0.05f, true));
  const auto e = flip_exposures(reference);
  REQUIRE(e);
  CHECK(e->start == near(-2.9641166));
  CHECK(e->stop == near(6.2783904));
  CHECK(e->count == 10);
  const auto r = hdr_flip(image, reference, 2);
  REQUIRE(r);
  CHECK(r->mean == near(0.1566906));
  CHECK(at(*r, 0, 0) == near(0.549717));
  CHECK(at(*r, 20, 12) == near(0.097429));
  CHECK(at(*r, 47, 39) == near(0.063156));
  CHECK(at(*r, 10, 30) == near(0.142603));
}

TEST_CASE("FLIP is nothing for equal images and defined for bad ones") {
  const Image image = pattern(1, false);
  CHECK(ldr_flip(image, image).mean == 0);
  CHECK(hdr_flip(image, image)->mean == 0);
  CHECK_FALSE(hdr_flip(image, pattern(0, false)).has_value());
  Image holes = image;
  holes.data[7] = NAN;
  holes.data[100] = INFINITY;
  holes.data[200] = -3;
  for (const double mean : {ldr_flip(holes, image).mean, hdr_flip(holes, image)->mean}) {
    CHECK(mean > 0);
    CHECK(mean < 0.1);
  }
  CHECK_THROWS_AS(ldr_flip(image, plain(1, 1, 1)), std::invalid_argument);
  CHECK_THROWS_AS(ldr_flip(Image(4, 4, {"A"}), Image(4, 4, {"A"})), std::invalid_argument);
}
