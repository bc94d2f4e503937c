#include "image/denoiser_bias.h"

#include <algorithm>
#include <cmath>

namespace duet {

namespace {

constexpr int kRadius = 2;
/// Of the mean square of all colours: what is darker does not count for more.
constexpr double kDark = 0.01;

double mean_square(const std::vector<float>& values) {
  double sum = 0;
  for (const float v : values) sum += double(v) * double(v);
  return sum / double(std::max<size_t>(values.size(), 1));
}

}  // namespace

void limit_bias(const ImageWithNoise& noisy, std::vector<float>& denoised) {
  const int w = noisy.width, h = noisy.height;
  const double least = std::max(kDark * mean_square(denoised), 1e-30);
  // Summed over the three colours.
  std::vector<double> difference(size_t(w) * size_t(h)), variance(difference.size());
  for (size_t i = 0; i < denoised.size(); ++i) {
    const double d = double(noisy.colour[i]) - double(denoised[i]);
    const double scale = 1 / (double(denoised[i]) * double(denoised[i]) + least);
    difference[i / 3] += scale * d * d;
    variance[i / 3] += scale * double(noisy.variance[i]);
  }
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      double d = 0, v = 0;
      for (int ny = std::max(y - kRadius, 0); ny <= std::min(y + kRadius, h - 1); ++ny)
        for (int nx = std::max(x - kRadius, 0); nx <= std::min(x + kRadius, w - 1); ++nx) {
          const size_t n = size_t(ny) * size_t(w) + size_t(nx);
          d += difference[n], v += variance[n];
        }
      // Not where something is not finite, either.
      if (!(d > v) || !std::isfinite(d)) continue;
      const size_t first = 3 * (size_t(y) * size_t(w) + size_t(x));
      for (size_t i = first; i < first + 3; ++i)
        denoised[i] += float((1 - v / d) * (double(noisy.colour[i]) - double(denoised[i])));
    }
}

}  // namespace duet
