#include "image/display_metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "image/colours.h"
#include "math/spectrum.h"

namespace duet {

namespace {

using Plane = std::vector<float>;

/// One channel as a display shows it.
Plane displayed(const Colours& colours, int channel) {
  Plane plane(colours.pixels());
  for (size_t i = 0; i < plane.size(); ++i) {
    const auto v = float(colours(i, channel));
    plane[i] = v > 0 ? linear_to_srgb(std::min(v, 1.0f)) : 0.0f;
  }
  return plane;
}

std::array<double, kSsimWindow> gaussian() {
  std::array<double, kSsimWindow> weights;
  double sum = 0;
  for (int k = 0; k < kSsimWindow; ++k) {
    const double d = (k - kSsimWindow / 2) / 1.5;
    sum += weights[size_t(k)] = std::exp(-0.5 * d * d);
  }
  for (double& w : weights) w /= sum;
  return weights;
}

/// Weighted means over a window: of two images, their squares and their product.
struct Means {
  double a = 0, b = 0, aa = 0, bb = 0, ab = 0;
  void add(double weight, const Means& m) {
    a += weight * m.a, b += weight * m.b;
    aa += weight * m.aa, bb += weight * m.bb, ab += weight * m.ab;
  }
};

/// Wang et al., eq. 13, for values up to 1.
double similarity(const Means& m) {
  constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
  const double variances = (m.aa - m.a * m.a) + (m.bb - m.b * m.b);
  const double covariance = m.ab - m.a * m.b;
  return (2 * m.a * m.b + c1) * (2 * covariance + c2) /
         ((m.a * m.a + m.b * m.b + c1) * (variances + c2));
}

/// The sum of the similarities of all windows within the image. The Gaussian is separable: sums
/// along the rows are kept for as many rows as a window has.
double similarity_sum(const Plane& a, const Plane& b, int width, int height) {
  static const std::array<double, kSsimWindow> weights = gaussian();
  const int across = width - kSsimWindow + 1;
  std::array<std::vector<Means>, kSsimWindow> rows;
  double sum = 0;
  for (int y = 0; y < height; ++y) {
    std::vector<Means>& row = rows[size_t(y % kSsimWindow)];
    row.assign(size_t(across), {});
    for (int x = 0; x < across; ++x)
      for (int k = 0; k < kSsimWindow; ++k) {
        const size_t i = size_t(y) * size_t(width) + size_t(x + k);
        const double u = a[i], v = b[i];
        row[size_t(x)].add(weights[size_t(k)], {u, v, u * u, v * v, u * v});
      }
    if (y < kSsimWindow - 1) continue;
    for (int x = 0; x < across; ++x) {
      Means window;
      for (int k = 0; k < kSsimWindow; ++k)
        window.add(weights[size_t(k)], rows[size_t((y + 1 + k) % kSsimWindow)][size_t(x)]);
      sum += similarity(window);
    }
  }
  return sum;
}

}  // namespace

DisplayMetrics display_metrics(const Image& image, const Image& reference) {
  const int width = image.width, height = image.height;
  if (width != reference.width || height != reference.height)
    throw std::invalid_argument("the images have different sizes");
  const Colours a(image), b(reference);
  const bool has_windows = width >= kSsimWindow && height >= kSsimWindow;
  double squares = 0, similarities = 0;
  for (int c = 0; c < 3; ++c) {
    const Plane u = displayed(a, c), v = displayed(b, c);
    for (size_t i = 0; i < u.size(); ++i) squares += std::pow(double(u[i]) - v[i], 2);
    if (has_windows) similarities += similarity_sum(u, v, width, height);
  }
  DisplayMetrics m;
  m.psnr = squares > 0 ? 10 * std::log10(3 * double(a.pixels()) / squares)
                       : std::numeric_limits<double>::infinity();
  if (has_windows)
    m.ssim = similarities / (3.0 * (width - kSsimWindow + 1) * double(height - kSsimWindow + 1));
  return m;
}

}  // namespace duet
