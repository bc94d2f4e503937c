// A square of the film: the sums of the samples that are taken in it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "image/exact_sum.h"
#include "image/filter.h"
#include "math/vector.h"

namespace duet {

/// A rectangle of whole pixels; `x1` and `y1` are one past the end.
struct PixelBounds {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  bool empty() const { return x1 <= x0 || y1 <= y0; }
  bool contains(int x, int y) const { return x >= x0 && x < x1 && y >= y0 && y < y1; }
  bool operator==(const PixelBounds&) const = default;
  PixelBounds intersect(const PixelBounds& o) const;
  PixelBounds grow(int border) const {
    return {x0 - border, y0 - border, x1 + border, y1 + border};
  }
};

/// Whether a film can add such values: they are finite, and not absurdly large.
template <size_t N>
inline bool film_can_add(std::span<const float, N> values) {
  bool can = true;
  for (const float v : values) can &= std::abs(v) <= float(ExactSum::kLargest);
  return can;
}

/// The sums of the samples taken in one square of the film. A sample also counts for pixels beyond
/// the square, as far as the filter reaches; tiles keep those sums apart, so that threads share
/// nothing.
class FilmTile {
 public:
  /// `sampled` are the pixels in which samples are taken, `stored` those they may count for.
  FilmTile(const PixelBounds& sampled, const PixelBounds& stored, size_t channels);

  const PixelBounds& sampled() const { return sampled_; }
  const PixelBounds& stored() const { return stored_; }

  /// Takes note of `count` more samples in every pixel.
  void count_samples(uint64_t count) { samples_ += count; }
  /// Samples that every pixel has, as far as they have been counted.
  uint64_t samples() const { return samples_; }
  /// Per stored pixel, row by row, the sum of weights, then the weighted sum of each channel.
  std::span<const ExactSum> sums() const { return sums_; }
  std::span<ExactSum> sums() { return sums_; }
  /// Where the sums of a stored pixel begin.
  size_t index(int x, int y) const {
    return (size_t(y - stored_.y0) * size_t(stored_.width()) + size_t(x - stored_.x0)) * stride_;
  }
  /// Adds the samples of a tile that stores some of these pixels, with the same channels.
  void add(const FilmTile& o);
  /// Removes all samples.
  void clear();

 private:
  friend class SampleAdder;
  PixelBounds sampled_, stored_;
  size_t stride_;  ///< sums per pixel
  uint64_t samples_ = 0;
  std::vector<ExactSum> sums_;
};

/// A filter may be this wide.
inline constexpr int kMostPixelsInReach = 64;

/// Calls `f(x0, y, wx, wy)` for each row of `bounds` that a sample at `p` counts for: its pixels
/// from x0 on have the weights wx[i] wy.
template <class F>
void for_reached_rows(const ReconstructionFilter& filter, const Point2f& p,
                      const PixelBounds& bounds, F&& f) {
  const FilterProfile &along_x = filter.along_x(), &along_y = filter.along_y();
  const float rx = along_x.radius(), ry = along_y.radius();
  // Pixel i has its centre at i + 1/2.
  const int x0 = std::max(bounds.x0, int(std::ceil(p.x - rx - 0.5f)));
  const int x1 = std::min(bounds.x1 - 1, int(std::floor(p.x + rx - 0.5f)));
  const int y0 = std::max(bounds.y0, int(std::ceil(p.y - ry - 0.5f)));
  const int y1 = std::min(bounds.y1 - 1, int(std::floor(p.y + ry - 0.5f)));
  if (x0 > x1 || y0 > y1) return;
  float wx[kMostPixelsInReach];
  for (int x = x0; x <= x1; ++x) wx[x - x0] = along_x.weight(float(x) + 0.5f - p.x);
  for (int y = y0; y <= y1; ++y)
    f(x0, y, std::span<const float>(wx, size_t(x1 - x0 + 1)),
      along_y.weight(float(y) + 0.5f - p.y));
}

}  // namespace duet
