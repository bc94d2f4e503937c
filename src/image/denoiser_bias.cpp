#include "image/denoiser_bias.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace duet {

namespace {

constexpr int kRadius = 2;
/// Of the mean square of all colours: what is darker does not count for more.
constexpr double kDark = 0.01;
/// Noise of so small a share of the colour is not worth a bias: a third of a step of an sRGB image
/// of 8 bits at white, where the steps are the least.
constexpr double kUnseen = 0.003;
/// How much of the known noise is added to see what of it stays.
constexpr float kStep = 0.5f;

double mean_square(const std::vector<float>& values) {
  double sum = 0;
  for (const float v : values) sum += double(v) * double(v);
  return sum / double(std::max<size_t>(values.size(), 1));
}

/// What the denoiser makes of the noisy colours with a step of the known noise.
std::vector<float> denoise_with_step(const ImageWithNoise& noisy, const DenoiseColours& denoise) {
  std::vector<float> colours = noisy.colour;
  for (size_t i = 0; i < colours.size(); ++i) colours[i] += kStep * noisy.noise[i];
  return denoise(std::move(colours));
}

}  // namespace

void limit_bias(const ImageWithNoise& noisy, const DenoiseColours& denoise,
                std::vector<float>& denoised) {
  const int w = noisy.width, h = noisy.height;
  const std::vector<float> moved = denoise_with_step(noisy, denoise);
  const double least = std::max(kDark * mean_square(denoised), 1e-30);
  // Summed over the three colours: D and V - C.
  std::vector<double> difference(size_t(w) * size_t(h)), taken(difference.size());
  for (size_t i = 0; i < denoised.size(); ++i) {
    const double d = double(noisy.colour[i]) - double(denoised[i]);
    const double scale = 1 / (double(denoised[i]) * double(denoised[i]) + least);
    difference[i / 3] += scale * d * d;
    const double noise = noisy.noise[i];
    const double kept = (double(moved[i]) - double(denoised[i])) / double(kStep);
    taken[i / 3] += scale * noise * (noise - kept) - kUnseen * kUnseen;
  }
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      double d = 0, v = 0;
      for (int ny = std::max(y - kRadius, 0); ny <= std::min(y + kRadius, h - 1); ++ny)
        for (int nx = std::max(x - kRadius, 0); nx <= std::min(x + kRadius, w - 1); ++nx) {
          const size_t n = size_t(ny) * size_t(w) + size_t(nx);
          d += difference[n], v += taken[n];
        }
      v = std::max(v, 0.0);
      // Not where something is not finite, either.
      if (!(d > v) || !std::isfinite(d)) continue;
      const size_t first = 3 * (size_t(y) * size_t(w) + size_t(x));
      for (size_t i = first; i < first + 3; ++i)
        denoised[i] += float((1 - v / d) * (double(noisy.colour[i]) - double(denoised[i])));
    }
}

}  // namespace duet
