// Discrete and piecewise distributions built from tables of weights.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "math/hash.h"
#include "math/vector.h"
#include "math/warp.h"

namespace duet {

/// The interval of a cumulative sum in which `u` (in [0, 1)) lies. `cdf` has n + 1 entries from 0
/// to 1; entry i of `guide` is the interval in which i/n lies, from where the search takes a step
/// or two on average, whatever the weights. Source: Chen & Asau, "On Generating Random Variates
/// from an Empirical Distribution", 1974.
template <class Real, class Index>
inline uint32_t find_interval(const Real* cdf, const Index* guide, uint32_t n, Real u) {
  const uint32_t k = uint32_t(u * Real(n));
  uint32_t i = guide[k < n ? k : n - 1];
  while (cdf[i + 1] <= u) ++i;
  while (cdf[i] > u) --i;  // the product above may have been rounded up
  return i;
}

/// The 24 bits of `u` in [0, 1), and 29 more: a hash of it and of `others`, two numbers that are
/// used for something else besides.
inline double fine_variate(float u, const Point2f& others) {
  const uint64_t both =
      uint64_t(std::bit_cast<uint32_t>(others.x)) << 32 | std::bit_cast<uint32_t>(others.y);
  const uint64_t more = hash_combine(std::bit_cast<uint32_t>(u), both) >> 35;
  return double(u) + double(more) * 0x1p-53;
}

/// Picks an index with probability proportional to its weight, by inversion of the cumulative sum,
/// so that well distributed variates stay well distributed. The probabilities that it tells are
/// those with which it picks: differences of the cumulative sum, which is in double precision and
/// met by variates of 53 bits where there are more than kMostCoarse weights.
class DiscreteDistribution {
 public:
  /// A variate of 24 bits makes the probability of one among n equal indices wrong by n / 2²⁴ of
  /// it: no more than 1/4096.
  static constexpr size_t kMostCoarse = 4096;

  DiscreteDistribution() = default;
  /// Weights must be finite and not negative. If they are all zero, every index gets equal weight.
  explicit DiscreteDistribution(std::span<const float> weights);

  struct Pick {
    uint32_t index;
    float probability;
    float remapped;  ///< uniform in [0, 1) again, independent of the index
  };
  /// `others` as in fine_variate(), which large tables need.
  Pick sample(float u, const Point2f& others) const {
    if (!fine_cdf_.empty()) return pick(fine_cdf_, fine_variate(u, others));
    return pick(cdf_, u);
  }
  /// The same among the `count` indices from `first` on, one of which must have weight.
  Pick sample_within(uint32_t first, uint32_t count, float u, const Point2f& others) const {
    if (!fine_cdf_.empty()) return pick_within(fine_cdf_, first, count, fine_variate(u, others));
    return pick_within(cdf_, first, count, u);
  }
  float probability(uint32_t index) const {
    return fine_cdf_.empty() ? cdf_[index + 1] - cdf_[index]
                             : float(fine_cdf_[index + 1] - fine_cdf_[index]);
  }
  /// That of the `count` indices from `first` on.
  float probability(uint32_t first, uint32_t count) const {
    return fine_cdf_.empty() ? cdf_[first + count] - cdf_[first]
                             : float(fine_cdf_[first + count] - fine_cdf_[first]);
  }
  size_t size() const { return guide_.size(); }
  /// Sum of the weights as they were given.
  double sum() const { return sum_; }

 private:
  template <class Real>
  Pick pick(const std::vector<Real>& cdf, Real u) const {
    const uint32_t i = find_interval(cdf.data(), guide_.data(), uint32_t(guide_.size()), u);
    const Real p = cdf[i + 1] - cdf[i];
    return {i, float(p), std::min(float((u - cdf[i]) / p), kBelowOne)};
  }
  template <class Real>
  Pick pick_within(const std::vector<Real>& cdf, uint32_t first, uint32_t count, Real u) const {
    const Real from = cdf[first], width = cdf[first + count] - from;
    // Rounding must not lead out of the range, nor to what has no weight.
    const Real last = std::nextafter(cdf[first + count], Real(0));
    Pick p = pick(cdf, std::min(from + u * width, last));
    p.probability /= float(width);
    return p;
  }

  std::vector<float> cdf_;        ///< of up to kMostCoarse weights
  std::vector<double> fine_cdf_;  ///< of more
  std::vector<uint32_t> guide_;
  double sum_ = 0;
};

/// Inverts the cumulative distribution of the linear density on [0, 1] with end values a and b.
inline float sample_linear(float u, float a, float b) {
  const float sum = a + b;
  if (!(sum > 0)) return u;
  // Stable for a → b: the root of (b − a) x² / 2 + a x = u (a + b) / 2.
  const float root = safe_sqrt(a * a + u * (b * b - a * a));
  return std::min(u * sum / (a + root), kBelowOne);
}

/// A density on the unit square that is bilinear within the cells of a grid of node values: width ×
/// height nodes sit at the corners of (width − 1) × (height − 1) cells that tile the square. Rows
/// are picked by their marginal, cells by the conditional, and the position in the cell by
/// inverting the bilinear interpolant, so the density is continuous and follows the interpolated
/// function exactly.
///
/// The nodes stay with the caller, who often has them in another form: every function that needs
/// them takes a `node(x, y)` that yields a finite value ≥ 0, always the same one.
class BilinearDistribution {
 public:
  /// The guides of rows have 16 bits.
  static constexpr int kMaxWidth = 1 << 16;

  BilinearDistribution() = default;
  template <class Node>
  BilinearDistribution(int width, int height, const Node& node)
      : BilinearDistribution(width, height) {
    std::vector<float> weights(size_t(width) - 1);
    for (int y = 0; y + 1 < height; ++y) {
      for (int x = 0; x + 1 < width; ++x)
        weights[size_t(x)] =
            0.25f * ((node(x, y) + node(x + 1, y)) + (node(x, y + 1) + node(x + 1, y + 1)));
      add_row(y, weights);
    }
    finish();
  }

  struct Sample {
    int x, y;       ///< the cell
    float dx, dy;   ///< position in it, from 0 to 1
    float density;  ///< per unit area of the square
  };
  template <class Node>
  Sample sample(const Point2f& u, const Node& node) const {
    const auto row = rows_.sample(u.y, u);
    const uint32_t n = uint32_t(width_) - 1;
    const float* cdf = &conditional_[size_t(row.index) * uint32_t(width_)];
    const uint32_t i = find_interval(cdf, &guides_[size_t(row.index) * n], n, u.x);
    const float ux = std::min((u.x - cdf[i]) / (cdf[i + 1] - cdf[i]), kBelowOne);
    const int x = int(i), y = int(row.index);
    const float f00 = node(x, y), f10 = node(x + 1, y), f01 = node(x, y + 1),
                f11 = node(x + 1, y + 1);
    // First along y by the sums of the edges, then along x by the interpolated edge.
    const float dy = sample_linear(row.remapped, f00 + f10, f01 + f11);
    const float left = lerp(f00, f01, dy), right = lerp(f10, f11, dy);
    const float dx = sample_linear(ux, left, right);
    return {x, y, dx, dy, uniform_ ? 1.0f : lerp(left, right, dx) * inv_integral_};
  }
  /// The density at (dx, dy) within the cell (x, y).
  template <class Node>
  float density(int x, int y, float dx, float dy, const Node& node) const {
    if (uniform_) return 1;
    return lerp(lerp(node(x, y), node(x + 1, y), dx), lerp(node(x, y + 1), node(x + 1, y + 1), dx),
                dy) *
           inv_integral_;
  }
  /// Integral of the interpolant over the unit square.
  double integral() const { return integral_; }

 private:
  BilinearDistribution(int width, int height);
  void add_row(int y, std::span<const float> weights);
  void finish();

  int width_ = 0, height_ = 0;
  DiscreteDistribution rows_;
  std::vector<float> marginal_;  ///< only while building
  /// One cumulative sum per row of cells, each of width_ entries from 0 to 1, and its guide.
  std::vector<float> conditional_;
  std::vector<uint16_t> guides_;
  double integral_ = 0;
  float inv_integral_ = 0;
  bool uniform_ = false;  ///< all nodes are zero
};

}  // namespace duet
