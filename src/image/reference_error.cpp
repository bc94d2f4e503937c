#include "image/reference_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "image/colours.h"
#include "image/metrics.h"

namespace duet {

namespace {

std::vector<double> colours_of(const Image& image, const char* what) {
  const Colours colours(image);
  std::vector<double> values(3 * colours.pixels());
  for (size_t i = 0; i < values.size(); ++i) {
    values[i] = colours(i / 3, int(i % 3));
    if (!std::isfinite(values[i]))
      throw std::invalid_argument(fmt::format("{} has values that are not finite", what));
  }
  return values;
}

/// The weight of a squared error in relMSE.
double weight(double reference) {
  return 1 / (reference * reference + 0.01);
}

}  // namespace

NoisyReference::NoisyReference(const Image& mean, const Image* variance)
    : width_(mean.width), height_(mean.height), mean_(colours_of(mean, "the reference")) {
  if (!variance) return;
  if (variance->width != width_ || variance->height != height_)
    throw std::invalid_argument(fmt::format("the variance is {}x{}, the reference {}x{}",
                                            variance->width, variance->height, width_, height_));
  variance_ = colours_of(*variance, "the variance");
  std::vector<double> relative(mean_.size() / 3);
  for (size_t i = 0; i < mean_.size(); ++i)
    relative[i / 3] += std::max(0.0, variance_[i]) * weight(mean_[i]) / 3;
  std::sort(relative.begin(), relative.end());
  const size_t kept = trimmed_count(relative.size());
  noise_ = std::accumulate(relative.begin(), relative.begin() + std::ptrdiff_t(kept), 0.0) /
           double(kept);
}

ReferenceErrors NoisyReference::errors(const Image& image) const {
  if (image.width != width_ || image.height != height_)
    throw std::invalid_argument(fmt::format("the image is {}x{}, the reference {}x{}", image.width,
                                            image.height, width_, height_));
  const Colours colours(image);
  const size_t pixels = colours.pixels();
  ReferenceErrors e;
  std::vector<double> measured(pixels), debiased(pixels), luminances(pixels);
  for (size_t i = 0; i < pixels; ++i) {
    bool finite = true;
    for (int c = 0; c < 3; ++c) finite &= std::isfinite(colours(i, c));
    luminances[i] = finite ? colours.luminance(i) : 0;
    for (size_t c = 0; c < 3; ++c) {
      const double b = mean_[3 * i + c], d = (finite ? colours(i, int(c)) : 0) - b;
      const double noise = variance_.empty() ? 0 : std::max(0.0, variance_[3 * i + c]);
      e.mse += (d * d - noise) / double(3 * pixels);
      measured[i] += d * d * weight(b) / 3;
      debiased[i] += (d * d - noise) * weight(b) / 3;
    }
    e.relmse += debiased[i] / double(pixels);
  }
  // The worst pixels are left out as they were measured: the noise that is subtracted must not
  // choose.
  const size_t kept = trimmed_count(pixels);
  std::vector<size_t> order(pixels);
  std::iota(order.begin(), order.end(), size_t(0));
  std::nth_element(order.begin(), order.begin() + std::ptrdiff_t(kept), order.end(),
                   [&](size_t a, size_t b) { return measured[a] < measured[b]; });
  e.tile_sums.resize(kTiles * kTiles);
  e.tile_pixels.resize(kTiles * kTiles);
  for (size_t k = 0; k < kept; ++k) {
    const int x = int(order[k]) % width_, y = int(order[k]) / width_;
    const auto tile = size_t(y * kTiles / height_ * kTiles + x * kTiles / width_);
    e.tile_sums[tile] += debiased[order[k]];
    e.tile_pixels[tile] += 1;
    e.trimmed += debiased[order[k]] / double(kept);
  }
  e.firefly = brightest_share(std::move(luminances));
  return e;
}

}  // namespace duet
