#include "image/resample.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace duet {

namespace {

/// What one row or column is made of: for each new number the first old one that counts, and the
/// weights from there on.
struct Taps {
  int per_number;
  std::vector<int> first;
  std::vector<double> weights;
};

Taps make_taps(int size, int new_size, const FilterDescription& filter) {
  const double radius = filter_radius(filter);
  Taps taps{std::max(1, int(std::ceil(2 * radius))), {}, {}};
  for (int i = 0; i < new_size; ++i) {
    const double center = (i + 0.5) / new_size * size;
    const int first = int(std::floor(center - radius + 0.5));
    double sum = 0;
    for (int j = 0; j < taps.per_number; ++j) {
      taps.weights.push_back(evaluate_filter(filter, first + j + 0.5 - center));
      sum += taps.weights.back();
    }
    const auto begin = taps.weights.end() - taps.per_number;
    if (sum == 0) {
      // So narrow a filter that it reaches no pixel: the nearest one.
      taps.first.push_back(int(center));
      *begin = 1;
    } else {
      taps.first.push_back(first);
      for (auto w = begin; w != taps.weights.end(); ++w) *w /= sum;
    }
  }
  return taps;
}

/// The new number `i` from old ones that lie `stride` apart.
float apply(const Taps& taps, int i, const float* values, int size, size_t stride) {
  double sum = 0;
  for (int j = 0; j < taps.per_number; ++j)
    sum += taps.weights[size_t(i) * size_t(taps.per_number) + size_t(j)] *
           double(values[size_t(std::clamp(taps.first[size_t(i)] + j, 0, size - 1)) * stride]);
  return float(sum);
}

}  // namespace

std::vector<float> enlarge(std::vector<float> values, int width, int height, int new_width,
                           int new_height, const FilterDescription& filter) {
  assert(new_width >= width && new_height >= height);
  if (new_width != width) {
    const Taps taps = make_taps(width, new_width, filter);
    std::vector<float> wide;
    wide.reserve(size_t(new_width) * size_t(height));
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < new_width; ++x)
        wide.push_back(apply(taps, x, &values[size_t(y) * size_t(width)], width, 1));
    values = std::move(wide);
  }
  if (new_height != height) {
    const Taps taps = make_taps(height, new_height, filter);
    std::vector<float> tall;
    tall.reserve(size_t(new_width) * size_t(new_height));
    for (int y = 0; y < new_height; ++y)
      for (int x = 0; x < new_width; ++x)
        tall.push_back(apply(taps, y, &values[size_t(x)], height, size_t(new_width)));
    values = std::move(tall);
  }
  return values;
}

}  // namespace duet
