// Discrete and piecewise distributions built from tables of weights.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/vector.h"

namespace duet {

/// Picks an index with probability proportional to its weight, by inversion of the cumulative sum,
/// so that well distributed variates stay well distributed.
class DiscreteDistribution {
 public:
  DiscreteDistribution() = default;
  /// Weights must be finite and not negative. If they are all zero, every index gets equal weight.
  explicit DiscreteDistribution(std::span<const float> weights);

  struct Pick {
    uint32_t index;
    float probability;
    float remapped;  ///< uniform in [0, 1) again, independent of the index
  };
  Pick sample(float u) const;
  float probability(uint32_t index) const { return cdf_[index + 1] - cdf_[index]; }
  size_t size() const { return cdf_.empty() ? 0 : cdf_.size() - 1; }
  /// Sum of the weights as they were given.
  double sum() const { return sum_; }

 private:
  std::vector<float> cdf_;
  double sum_ = 0;
};

/// A density on the unit square that is bilinear within the cells of a grid of node values.
/// Rows are picked by their marginal, cells by the conditional, and the position in the cell by
/// inverting the bilinear interpolant, so the density is continuous and follows the interpolated
/// function exactly.
class BilinearDistribution {
 public:
  BilinearDistribution() = default;
  /// `nodes` holds width × height values (row-major, finite, not negative); they sit at the corners
  /// of (width − 1) × (height − 1) cells that tile the unit square.
  BilinearDistribution(std::vector<float> nodes, int width, int height);

  struct Sample {
    Point2f position;
    float density;  ///< per unit area of the square
  };
  Sample sample(Point2f u) const;
  float density(const Point2f& position) const;
  /// Integral of the interpolant over the unit square.
  double integral() const { return integral_; }

 private:
  float node(int x, int y) const { return nodes_[size_t(y) * width_ + x]; }

  std::vector<float> nodes_;
  int width_ = 0, height_ = 0;
  DiscreteDistribution rows_;
  /// One cumulative sum per row of cells, each of width_ entries from 0 to 1.
  std::vector<float> conditional_;
  double integral_ = 0;
};

/// Inverts the cumulative distribution of the linear density on [0, 1] with end values a and b.
float sample_linear(float u, float a, float b);

}  // namespace duet
