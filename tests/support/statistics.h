// Statistical tests: whether samples follow a density.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "math/statistics.h"
#include "math/vector.h"

namespace duet::test {

/// Outcome of a χ² test. `pass` is false also if samples fell where the density is zero.
struct Chi2Result {
  bool pass = false;
  double p_value = 0, statistic = 0;
  int dof = 0;
  std::string message;
};

/// Pearson's test of observed counts against expected ones. Cells that expect less than five are
/// pooled. `level` is the probability of rejecting a correct sampler.
Chi2Result chi2_test(const std::vector<double>& observed, const std::vector<double>& expected,
                     double level);

/// Tests samples on the unit square against a density that integrates to `mass` ≤ 1 (the rest are
/// failed samples). `sample` fills a position and returns false if it failed; `density` is
/// integrated over each of nx × ny cells by the midpoint rule on sub × sub points.
struct SquareTest {
  int nx = 40, ny = 20, sub = 8;
  int samples = 400000;
  double level = 0.01;
  uint64_t seed = 1;
};
Chi2Result chi2_square(const std::function<bool(Point2f u, Point2f& position)>& sample,
                       const std::function<double(Point2f)>& density,
                       const SquareTest& options = {});

/// The same for unit directions and a density per solid angle, over cells of (φ, cos θ).
/// `sample` receives three uniform numbers.
Chi2Result chi2_sphere(const std::function<bool(float u, Point2f v, Vector3f& direction)>& sample,
                       const std::function<double(const Vector3f&)>& density,
                       const SquareTest& options = {});

}  // namespace duet::test
