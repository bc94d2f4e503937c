#include "image/metrics.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "math/sampler.h"
#include "support/constant_image.h"

using namespace duet;
using namespace duet::test;

namespace {

/// Sum of twelve uniform numbers minus six: normal enough.
float normal(Sampler& s) {
  float sum = -6;
  for (int i = 0; i < 12; ++i) sum += s.next_1d();
  return sum;
}

Image with_noise(const Image& image, float sigma, uint64_t seed) {
  Image out = image;
  Sampler s(SampleSequence::independent, seed, 0, 0);
  s.start_sample(0);
  for (float& v : out.data) v += sigma * normal(s);
  return out;
}

}  // namespace

TEST_CASE("metrics of two images whose difference is known") {
  const Image b = constant_image(10, 10, 0.5f);
  Image a = b;
  a.data[0] += 0.3f;  // one value of 300
  const ImageMetrics m = compare_images(a, b, std::nullopt);
  CHECK(m.rmse == doctest::Approx(std::sqrt(0.09 / 300)).epsilon(1e-5));
  CHECK(m.relative_rmse == doctest::Approx(m.rmse / 0.5));
  CHECK(m.mae == doctest::Approx(0.001).epsilon(1e-5));
  CHECK(m.relmse == doctest::Approx(0.09 / 0.26 / 300).epsilon(1e-5));
  CHECK(m.mean_ratio[0] == doctest::Approx(1 + 0.3 / 50).epsilon(1e-6));
  CHECK(m.mean_ratio[1] == doctest::Approx(1));
  CHECK(!m.bias);
  CHECK(!m.z_share);
}

TEST_CASE("two black images are the same, and what is lit is infinitely brighter than black") {
  const Image black = constant_image(10, 10, 0), lit = constant_image(10, 10, 1);
  const NoiseModel noise{&black, 16, 16};
  const ImageMetrics same = compare_images(black, black, noise);
  CHECK(same.relative_rmse == 0);
  CHECK(same.mean_ratio == std::array{1.0, 1.0, 1.0});
  CHECK(*same.bias == 0);
  CHECK(*same.z_share == 1);
  CHECK(*same.z_rms == 0);
  const ImageMetrics other = compare_images(lit, black, noise);
  CHECK(std::isinf(other.relative_rmse));
  CHECK(std::isinf(other.mean_ratio[0]));
  CHECK(std::isinf(*other.bias));
  CHECK(*other.z_share == 0);
}

TEST_CASE("the trimmed error leaves out the worst thousandth of the pixels") {
  const Image b = constant_image(100, 20, 1);
  Image a = b;
  for (int i = 0; i < 3; ++i) a.data[i] = 100;  // one pixel
  for (int i = 3; i < 6; ++i) a.data[i] = 50;   // another
  CHECK(compare_images(a, b, std::nullopt).relmse_trimmed == 0);
  for (int i = 6; i < 9; ++i) a.data[i] = 2;  // 2000 pixels: only two may be left out
  CHECK(compare_images(a, b, std::nullopt).relmse_trimmed > 0);
}

TEST_CASE("fireflies and the worst pixels have a share") {
  const Image b = constant_image(100, 20, 1);
  Image a = b;
  for (int i = 0; i < 3; ++i) a.data[i] = 500;  // one firefly among 2000 pixels
  for (int i = 3; i < 600; i += 3) a.data[i] = 2;
  const ImageMetrics m = compare_images(a, b, std::nullopt);
  // The two brightest pixels are left out: the firefly and one with red doubled.
  const double total = 500 + 1999 + 199 * 0.212671;
  CHECK(m.firefly == doctest::Approx((500 + 1.212671) / total).epsilon(1e-5));
  CHECK(m.worst == doctest::Approx((499.0 * 499 * 3 + 1) / (499.0 * 499 * 3 + 199)).epsilon(1e-5));
  CHECK(compare_images(b, b, std::nullopt).worst == 0);
  CHECK(compare_images(b, b, std::nullopt).firefly == doctest::Approx(0.001));
}

TEST_CASE("false colours grow lighter and mark what is no number") {
  std::vector<float> values;
  for (int i = -1; i <= 33; ++i) values.push_back(float(i) / 32);
  values.push_back(NAN);
  const std::vector<uint8_t> bytes = false_colours(values);
  double before = -1;
  for (size_t i = 0; i + 1 < values.size(); ++i) {
    const double y = 0.2126 * bytes[3 * i] + 0.7152 * bytes[3 * i + 1] + 0.0722 * bytes[3 * i + 2];
    if (values[i] > 0 && values[i] <= 1)
      CHECK(y > before);
    else
      CHECK(y >= before);
    before = y;
  }
  const size_t last = 3 * (values.size() - 1);
  CHECK(bytes[last] == 0);
  CHECK(bytes[last + 1] == 255);
  Image dark = constant_image(2, 1, 1), bright = constant_image(2, 1, 1);
  for (int c = 0; c < 3; ++c) dark.data[size_t(c)] = 0, bright.data[size_t(c)] = 0.01f;
  const std::vector<float> d = relative_differences(bright, dark);
  CHECK(d[0] == doctest::Approx(0.01 / 0.005));  // the mean is 0.5
  CHECK(d[1] == 0);
}

TEST_CASE("noise of the stated variance passes the z-test, a shift does not") {
  const Image b = constant_image(64, 64, 0.5f), variance = constant_image(64, 64, 0.04f);
  const NoiseModel noise{&variance, 16, 1e9};  // standard error 0.05
  const Image a = with_noise(b, 0.05f, 1);
  ImageMetrics m = compare_images(a, b, noise);
  CHECK(*m.z_share > 0.9999);
  CHECK(*m.z_rms == doctest::Approx(1).epsilon(0.03));
  CHECK(std::abs(*m.bias) < 4);
  // A bias too small for any single pixel, but not for the mean of all.
  Image shifted = a;
  for (float& v : shifted.data) v += 0.01f;
  m = compare_images(shifted, b, noise);
  CHECK(*m.z_share > 0.9975);
  CHECK(*m.bias > 4);
  // Half of the noise is the reference's, which has as many samples.
  m = compare_images(with_noise(a, 0.05f, 3), b, NoiseModel{&variance, 16, 16});
  CHECK(*m.z_rms == doctest::Approx(1).epsilon(0.03));
  // Twice the noise that the samples explain.
  m = compare_images(with_noise(b, 0.15f, 2), b, noise);
  CHECK(*m.z_share < kRequiredZShare);
}

TEST_CASE("values that are not numbers are counted and left out") {
  const Image b = constant_image(4, 4, 1);
  Image a = b;
  a.data[0] = std::numeric_limits<float>::quiet_NaN();
  a.data[3] = std::numeric_limits<float>::infinity();
  a.data[6] = -1;
  const ImageMetrics m = compare_images(a, b, std::nullopt);
  CHECK(m.nan_pixels == 1);
  CHECK(m.infinite_pixels == 1);
  CHECK(m.negative_pixels == 1);
  CHECK(std::isfinite(m.rmse));
  const Image variance = constant_image(4, 4, 1);
  const ImageMetrics z = compare_images(a, b, NoiseModel{&variance, 1, 1});
  CHECK(*z.z_share < 1);  // never good
}

TEST_CASE("images that cannot be compared are refused") {
  CHECK_THROWS_AS(compare_images(constant_image(2, 2, 1), constant_image(2, 3, 1), std::nullopt),
                  std::invalid_argument);
  CHECK_THROWS_AS(compare_images(Image(2, 2, {"U", "V"}), constant_image(2, 2, 1), std::nullopt),
                  std::invalid_argument);
}

TEST_CASE("the difference image is red where brighter and blue where darker") {
  const Image b = constant_image(3, 1, 0.5f);
  Image a = b;
  for (int c = 0; c < 3; ++c) a.pixel(0, 0)[c] = 1, a.pixel(1, 0)[c] = 0;
  const auto bytes = difference_image(a, b, 0.5);
  CHECK(std::vector<int>(bytes.begin(), bytes.end()) ==
        std::vector<int>{255, 0, 0, 0, 0, 255, 255, 255, 255});
}
