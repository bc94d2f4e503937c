#include "math/distribution.h"

#include <cassert>

namespace duet {

namespace {

/// Turns weights into a cumulative sum from 0 to exactly 1 in `cdf` (one entry more than weights);
/// returns the sum. Weights that are all zero are treated as equal.
template <class Weight>
double accumulate(size_t n, const Weight& weight, float* cdf) {
  double sum = 0;
  for (size_t i = 0; i < n; ++i) sum += weight(i);
  double running = 0;
  cdf[0] = 0;
  for (size_t i = 0; i < n; ++i) {
    running += sum > 0 ? weight(i) / sum : 1.0 / double(n);
    cdf[i + 1] = float(running);
  }
  // The last entry with weight closes the sum, so that no variate below 1 falls behind it.
  size_t last = n;
  while (last > 1 && cdf[last - 1] == cdf[last]) --last;
  for (size_t i = last; i <= n; ++i) cdf[i] = 1;
  return sum;
}

/// The largest i < n with cdf[i] <= u whose interval is not empty.
inline uint32_t find_interval(const float* cdf, size_t n, float u) {
  const float* it = std::upper_bound(cdf, cdf + n + 1, u);
  const size_t i = size_t(it - cdf);
  return uint32_t(std::min(i == 0 ? 0 : i - 1, n - 1));
}

}  // namespace

DiscreteDistribution::DiscreteDistribution(std::span<const float> weights)
    : cdf_(weights.size() + 1) {
  assert(!weights.empty());
  sum_ = accumulate(
      weights.size(), [&](size_t i) { return double(weights[i]); }, cdf_.data());
}

DiscreteDistribution::Pick DiscreteDistribution::sample(float u) const {
  const uint32_t i = find_interval(cdf_.data(), size(), u);
  const float p = cdf_[i + 1] - cdf_[i];
  return {i, p, std::clamp((u - cdf_[i]) / p, 0.0f, 0x1.fffffep-1f)};
}

float sample_linear(float u, float a, float b) {
  const float sum = a + b;
  if (!(sum > 0)) return u;
  // Stable for a → b: the root of (b − a) x² / 2 + a x = u (a + b) / 2.
  const float root = safe_sqrt(a * a + u * (b * b - a * a));
  return std::min(u * sum / (a + root), 0x1.fffffep-1f);
}

BilinearDistribution::BilinearDistribution(std::vector<float> nodes, int width, int height)
    : nodes_(std::move(nodes)), width_(width), height_(height) {
  assert(width >= 2 && height >= 2 && nodes_.size() == size_t(width) * height);
  conditional_.resize(size_t(width) * (height - 1));
  std::vector<float> marginal(height - 1);
  double total = 0;
  for (int y = 0; y + 1 < height; ++y) {
    const auto cell = [&](size_t x) {
      const int i = int(x);
      return 0.25 * (double(node(i, y)) + node(i + 1, y) + node(i, y + 1) + node(i + 1, y + 1));
    };
    const double row = accumulate(width - 1, cell, &conditional_[size_t(y) * width]);
    marginal[y] = float(row);
    total += row;
  }
  rows_ = DiscreteDistribution(marginal);
  integral_ = total / (double(width - 1) * (height - 1));
}

BilinearDistribution::Sample BilinearDistribution::sample(Point2f u) const {
  const auto row = rows_.sample(u.y);
  const float* cdf = &conditional_[size_t(row.index) * width_];
  const uint32_t x = find_interval(cdf, width_ - 1, u.x);
  const float ux = std::clamp((u.x - cdf[x]) / (cdf[x + 1] - cdf[x]), 0.0f, 0x1.fffffep-1f);
  const int y = int(row.index), i = int(x);
  const float f00 = node(i, y), f10 = node(i + 1, y), f01 = node(i, y + 1),
              f11 = node(i + 1, y + 1);
  // First along y by the sums of the edges, then along x by the interpolated edge.
  const float dy = sample_linear(row.remapped, f00 + f10, f01 + f11);
  const float dx = sample_linear(ux, lerp(f00, f01, dy), lerp(f10, f11, dy));
  const Point2f p{(float(i) + dx) / float(width_ - 1), (float(y) + dy) / float(height_ - 1)};
  const float value = lerp(lerp(f00, f10, dx), lerp(f01, f11, dx), dy);
  return {p, integral_ > 0 ? float(value / integral_) : 1.0f};
}

float BilinearDistribution::density(const Point2f& p) const {
  if (!(integral_ > 0)) return 1;
  const float x = std::clamp(p.x, 0.0f, 1.0f) * float(width_ - 1);
  const float y = std::clamp(p.y, 0.0f, 1.0f) * float(height_ - 1);
  const int i = std::min(int(x), width_ - 2), j = std::min(int(y), height_ - 2);
  const float dx = x - float(i), dy = y - float(j);
  return float(
      lerp(lerp(node(i, j), node(i + 1, j), dx), lerp(node(i, j + 1), node(i + 1, j + 1), dx), dy) /
      integral_);
}

}  // namespace duet
