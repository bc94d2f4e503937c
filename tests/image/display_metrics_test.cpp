#include "image/display_metrics.h"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

#include "image/percentage_errors.h"
#include "support/constant_image.h"

using namespace duet;
using namespace duet::test;

namespace {

struct Pair {
  Image a, b;
};

/// A wavy picture that a display cuts off at both ends, and one that differs from it everywhere.
Pair waves() {
  Pair p{Image(40, 30, {"R", "G", "B"}), Image(40, 30, {"R", "G", "B"})};
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x)
      for (int c = 0; c < 3; ++c) {
        const size_t i = size_t(3 * (y * 40 + x) + c);
        p.b.data[i] = float(0.6 + 0.8 * std::sin(0.37 * x + 0.23 * y * (c + 1)));
        p.a.data[i] = float(double(p.b.data[i]) + 0.1 * std::cos(1.7 * x * (c + 1) + 2.3 * y));
      }
  return p;
}

}  // namespace

TEST_CASE("PSNR and SSIM are those of scikit-image") {
  // Of scikit-image 0.26, peak_signal_noise_ratio(B, A, data_range=1) and structural_similarity(A,
  // B, channel_axis=2, gaussian_weights=True, sigma=1.5, use_sample_covariance=False,
  // data_range=1), where A and B are the images cut to [0, 1] and encoded as sRGB.
  const Pair p = waves();
  const DisplayMetrics m = display_metrics(p.a, p.b);
  CHECK(m.psnr == doctest::Approx(24.207998).epsilon(1e-6));
  REQUIRE(m.ssim);
  CHECK(*m.ssim == doctest::Approx(0.979235391).epsilon(1e-6));
}

TEST_CASE("PSNR and SSIM at their ends") {
  const Pair p = waves();
  const DisplayMetrics equal = display_metrics(p.b, p.b);
  CHECK(std::isinf(equal.psnr));
  CHECK(*equal.ssim == doctest::Approx(1).epsilon(1e-12));
  // White against black is the largest difference that a display can show.
  const DisplayMetrics most = display_metrics(constant_image(16, 16, 7), constant_image(16, 16, 0));
  CHECK(most.psnr == doctest::Approx(0));
  CHECK(*most.ssim == doctest::Approx(1e-4 / 1.0001));
  // What is brighter than white is white, and what is not a number is black.
  CHECK(std::isinf(
      display_metrics(constant_image(16, 16, 7), constant_image(16, 16, INFINITY)).psnr));
  CHECK(std::isinf(display_metrics(constant_image(16, 16, NAN), constant_image(16, 16, -1)).psnr));
  CHECK_FALSE(display_metrics(constant_image(10, 30, 1), constant_image(10, 30, 0)).ssim);
  CHECK(display_metrics(constant_image(11, 11, 1), constant_image(11, 11, 0)).ssim);
  CHECK_THROWS_AS(display_metrics(constant_image(10, 30, 1), constant_image(30, 10, 1)),
                  std::invalid_argument);
}

TEST_CASE("errors relative to the values") {
  const Pair p = waves();
  const PercentageErrors e = percentage_errors(p.a, p.b);
  CHECK(e.mape == doctest::Approx(0.312542891).epsilon(1e-5));
  CHECK(e.smape == doctest::Approx(0.274878673).epsilon(1e-5));
  const PercentageErrors known =
      percentage_errors(constant_image(4, 4, 2), constant_image(4, 4, 1));
  CHECK(known.mape == doctest::Approx(1 / 1.01));
  CHECK(known.smape == doctest::Approx(2 / 3.01));
  CHECK(percentage_errors(constant_image(4, 4, 0), constant_image(4, 4, 0)).smape == 0);
  // A pixel without a number is left out.
  Image hole = constant_image(4, 4, 2);
  hole.data[1] = NAN;
  CHECK(percentage_errors(hole, constant_image(4, 4, 1)).mape == doctest::Approx(1 / 1.01));
  CHECK_THROWS_AS(percentage_errors(constant_image(3, 4, 1), constant_image(4, 3, 1)),
                  std::invalid_argument);
}
