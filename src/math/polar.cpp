#include "math/polar.h"

#include <cmath>

namespace duet {

namespace {

/// Sum of the squares of the 3×3 block.
double squares(const Matrix4& m) {
  double sum = 0;
  for (int i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) sum += m[i][j] * m[i][j];
  return sum;
}

}  // namespace

PolarParts polar_parts(const Matrix4& m) {
  // Newton's iteration for the orthogonal factor converges quadratically; scaled, it needs about
  // ten steps for any matrix that can be inverted.
  constexpr int kSteps = 30;
  Matrix4 q;
  for (int i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) q[i][j] = m[i][j];
  for (int step = 0; step < kSteps; ++step) {
    const auto inverse = q.inverse();
    if (!inverse) break;
    // Near the end the scale is one but for rounding, which would keep the steps from settling.
    double scale = std::pow(squares(*inverse) / squares(q), 0.25);
    if (std::abs(scale - 1) < 1e-2) scale = 1;
    double change = 0;
    for (int i = 0; i < 3; ++i)
      for (size_t j = 0; j < 3; ++j) {
        const double next = 0.5 * (scale * q[i][j] + (*inverse)[int(j)][size_t(i)] / scale);
        change = std::max(change, std::abs(next - q[i][j]));
        q[i][j] = next;
      }
    if (change < 1e-15) break;
  }
  const double sign = q.determinant3() < 0 ? -1 : 1;
  PolarParts parts;
  for (int i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) {
      parts.rotation[i][j] = sign * q[i][j];
      parts.stretch[i][j] = 0;
    }
  for (int i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) parts.stretch[i][j] += parts.rotation[k][size_t(i)] * m[k][j];
  return parts;
}

}  // namespace duet
