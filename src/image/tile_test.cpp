#include "image/tile_test.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "image/colours.h"

namespace duet {

namespace {

constexpr int kCount = TileBatches::kTiles * TileBatches::kTiles;
/// Differences of this size relative to the mean are rounding, however often they are repeated.
constexpr double kRounding = 1e-5;
/// A difference of this size relative to the mean of the whole image does not count: what happens
/// that rarely in a tile that is next to black is not distributed as the test assumes.
constexpr double kNegligible = 1e-5;
/// With fewer images on a side the degrees of freedom that Welch & Satterthwaite estimate are too
/// uncertain that far out in the tails; those of the smaller side alone are on the safe side.
constexpr size_t kFewImages = 8;

}  // namespace

void TileBatches::add(const Image& image) {
  if (count_ > 0 && (image.width != width_ || image.height != height_))
    throw std::invalid_argument(fmt::format("an image is {}x{}, the first of its side {}x{}",
                                            image.width, image.height, width_, height_));
  if (image.width < kTiles || image.height < kTiles)
    throw std::invalid_argument(fmt::format("an image of {}x{} has no {}x{} tiles", image.width,
                                            image.height, kTiles, kTiles));
  const Colours colours(image);
  width_ = image.width, height_ = image.height;
  std::vector<double> sums(kCount), counts(kCount);
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      const auto tile = size_t((y * kTiles / height_) * kTiles + x * kTiles / width_);
      const size_t pixel = size_t(y) * size_t(width_) + size_t(x);
      sums[tile] += colours(pixel, 0) + colours(pixel, 1) + colours(pixel, 2);
      counts[tile] += 3;
    }
  double sum = 0;
  for (int i = 0; i < kCount; ++i) {
    const double mean = sums[size_t(i)] / counts[size_t(i)];
    tiles_[size_t(i)].add(mean);
    sum += mean;
  }
  total_.add(sum / kCount);
  ++count_;
}

TileComparison compare_tiles(const TileBatches& a, const TileBatches& b) {
  if (a.count() < 2 || b.count() < 2)
    throw std::invalid_argument("each side of a tile test needs two images at least");
  TileComparison c;
  c.ratio = a.total().mean() / b.total().mean();
  c.ratio_error = std::hypot(a.total().error() / b.total().mean(),
                             c.ratio * b.total().error() / b.total().mean());
  const size_t fewest = std::min(a.count(), b.count());
  std::vector<WelchTest> tests;
  std::vector<double> means, visible;
  for (int i = 0; i < kCount; ++i) {
    const double mean = b.tile(i).mean();
    if (mean > 0 && std::abs(a.tile(i).mean() / mean - 1) > std::abs(c.worst_ratio - 1))
      c.worst_ratio = a.tile(i).mean() / mean;
    WelchTest w = welch_test(a.tile(i).estimate(), b.tile(i).estimate(),
                             kNegligible * std::abs(b.total().mean()));
    if (w.error > 0 && fewest < kFewImages) {
      w.dof = double(fewest - 1);
      w.p = student_p_value(w.t, w.dof);
    }
    const double difference = a.tile(i).mean() - mean, rounding = kRounding * std::abs(mean);
    if (std::abs(difference) <= rounding && !(w.error > rounding)) continue;
    tests.push_back(w);
    means.push_back(mean);
  }
  c.tiles = int(tests.size());
  const double level = sidak(kTileSignificance, std::max(1, c.tiles));
  const double noticed_at = normal_quantile(level);
  constexpr double kPower80 = 0.8416;  // P(normal variate < this) = 0.8
  for (size_t i = 0; i < tests.size(); ++i) {
    const WelchTest& w = tests[i];
    c.rejected += w.p < level;
    c.least_p = std::min(c.least_p, w.p);
    // A difference without any variance is as bad as one can be, and still a number.
    const double z = normal_of_student(w.t, w.dof);
    c.mean_z2 += std::min(z * z, 1e12) / c.tiles;
    if (means[i] > 0)
      visible.push_back((student_of_normal(noticed_at, w.dof) + kPower80) * w.error / means[i]);
  }
  if (!visible.empty()) {
    std::sort(visible.begin(), visible.end());
    c.visible_bias = visible[visible.size() / 2];
    c.visible_bias_worst = visible.back();
  }
  return c;
}

}  // namespace duet
