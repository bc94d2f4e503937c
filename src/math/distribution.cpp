#include "math/distribution.h"

#include <cassert>

namespace duet {

namespace {

/// Turns weights into a cumulative sum from 0 to exactly 1 in `cdf` (one entry more than weights)
/// and its guide; returns the sum. Weights that are all zero are treated as equal.
template <class Real, class Index>
double accumulate(std::span<const float> weights, Real* cdf, Index* guide) {
  const size_t n = weights.size();
  double sum = 0;
  for (const float w : weights) sum += double(w);
  double running = 0;
  cdf[0] = 0;
  for (size_t i = 0; i < n; ++i) {
    running += sum > 0 ? double(weights[i]) : 1.0;
    cdf[i + 1] = Real(running / (sum > 0 ? sum : double(n)));
  }
  // The last entry with weight closes the sum, so that no variate below 1 falls behind it.
  size_t last = n;
  while (last > 1 && cdf[last - 1] == cdf[last]) --last;
  for (size_t i = last; i <= n; ++i) cdf[i] = 1;
  size_t interval = 0;
  for (size_t k = 0; k < n; ++k) {
    while (cdf[interval + 1] <= Real(double(k) / double(n))) ++interval;
    guide[k] = Index(interval);
  }
  return sum;
}

}  // namespace

DiscreteDistribution::DiscreteDistribution(std::span<const float> weights)
    : guide_(weights.size()) {
  assert(!weights.empty());
  if (weights.size() > kMostCoarse) {
    fine_cdf_.resize(weights.size() + 1);
    sum_ = accumulate(weights, fine_cdf_.data(), guide_.data());
  } else {
    cdf_.resize(weights.size() + 1);
    sum_ = accumulate(weights, cdf_.data(), guide_.data());
  }
}

BilinearDistribution::BilinearDistribution(int width, int height)
    : width_(width), height_(height), marginal_(size_t(height) - 1) {
  assert(width >= 2 && width <= kMaxWidth && height >= 2);
  conditional_.resize(size_t(width) * (size_t(height) - 1));
  guides_.resize((size_t(width) - 1) * (size_t(height) - 1));
}

void BilinearDistribution::add_row(int y, std::span<const float> weights) {
  const size_t row = size_t(y), w = size_t(width_);
  const double sum = accumulate(weights, &conditional_[row * w], &guides_[row * (w - 1)]);
  marginal_[row] = float(sum);
  integral_ += sum;
}

void BilinearDistribution::finish() {
  rows_ = DiscreteDistribution(marginal_);
  marginal_ = {};
  integral_ /= double(width_ - 1) * (height_ - 1);
  uniform_ = !(integral_ > 0);
  inv_integral_ = uniform_ ? 1.0f : float(1 / integral_);
}

}  // namespace duet
