#include "image/tile_test.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "image/colours.h"

namespace duet {

namespace {

constexpr int kCount = TileBatches::kTiles * TileBatches::kTiles;
constexpr int kTests = 3;  // single tiles, all tiles together, the whole images
/// Differences of this size relative to the mean are rounding, however often they are repeated.
constexpr double kRounding = 1e-5;
/// A difference of this size relative to the mean of the whole image does not count: what happens
/// that rarely in a tile that is next to black is not distributed as the test assumes.
constexpr double kNegligibleDifference = 1e-5;
/// With fewer images on a side the degrees of freedom that Welch & Satterthwaite estimate are too
/// uncertain that far out in the tails; those of the smaller side alone are on the safe side.
constexpr size_t kFewImages = 8;
/// A difference without any variance is as bad as one can be, and still a number.
constexpr double kLargestZ2 = 1e12;

/// A tile that is tested.
struct TestedTile {
  int tile = 0;
  WelchTest test;
  double mean = 0;   ///< of the reference
  double error = 0;  ///< of the difference, not below what is usual around it
};

/// Where few samples carry much light, most tiles of a set have met none of them: they are too dark
/// and seem to have less noise than they have. So the error of a tile is at least that of the 3×3
/// tiles around it, whose variance goes with the light as that of rare events does.
void find_cautious_errors(std::vector<TestedTile>& tiles) {
  constexpr int n = TileBatches::kTiles;
  for (TestedTile& t : tiles) {
    double error2 = 0;
    int count = 0;
    for (const TestedTile& o : tiles) {
      const int dx = std::abs(o.tile % n - t.tile % n), dy = std::abs(o.tile / n - t.tile / n);
      if (dx > 1 || dy > 1) continue;
      const double light = t.mean > 0 && o.mean > 0 ? t.mean / o.mean : 1;
      error2 += light * o.test.error * o.test.error;
      ++count;
    }
    t.error = std::max(t.test.error, std::sqrt(error2 / count));
  }
}

/// The residuals of a side's images, in units such that the sum of their products for two tiles is
/// the part that this side has in the correlation of the tiles' t.
std::vector<std::vector<double>> residuals(const TileBatches& side,
                                           const std::vector<TestedTile>& tiles) {
  std::vector<std::vector<double>> rows;
  const double n = double(side.count());
  for (const TileBatches::Means& means : side.images()) {
    std::vector<double>& row = rows.emplace_back();
    for (const TestedTile& t : tiles)
      row.push_back(t.error > 0 ? (means[size_t(t.tile)] - side.tile(t.tile).mean()) /
                                      (t.error * std::sqrt(n * (n - 1)))
                                : 0);
  }
  return rows;
}

/// The degrees of freedom of the sum of the tiles' z², which are fewer than the tiles where these
/// vary together: (tr R)² / tr R² of their correlations R. Of the trace that few images show, what
/// chance adds is taken off. Source: Bai & Saranadasa, "Effect of high dimension: by an example of
/// a two sample problem", Statistica Sinica 6, 1996. Not of fewer, for it is uncertain then.
double joint_dof(const TileBatches& a, const TileBatches& b, const std::vector<TestedTile>& tiles) {
  std::vector<std::vector<double>> rows = residuals(a, tiles);
  for (std::vector<double>& row : residuals(b, tiles)) rows.push_back(std::move(row));
  double trace = 0, inverse_dof = 0;
  for (const std::vector<double>& x : rows)
    for (const std::vector<double>& y : rows) {
      double product = 0;
      for (size_t i = 0; i < x.size(); ++i) product += x[i] * y[i];
      trace += product * product;
    }
  const double k = double(tiles.size());
  for (const TestedTile& t : tiles) inverse_dof += 1 / (t.test.dof * k);
  if (std::min(a.count(), b.count()) >= 2 * kFewImages) trace -= k * k * inverse_dof;
  return k * k / std::max(k, trace);
}

/// The p-values of the three tests and of all, from what is known of the tiles.
void find_p_values(const TileBatches& a, const TileBatches& b, std::vector<TestedTile>& tested,
                   TileComparison& c) {
  if (tested.empty()) return;
  find_cautious_errors(tested);
  double least = 1, z2 = 0;
  for (const TestedTile& t : tested) {
    const double share = t.test.error > 0 ? t.test.error / t.error : 1;
    const double z = normal_of_student(t.test.t * share, t.test.dof);
    least = std::min(least, t.test.p < 1 ? student_p_value(t.test.t * share, t.test.dof) : 1);
    z2 += std::min(z * z, kLargestZ2);
  }
  const double dof = joint_dof(a, b, tested);
  c.tile_p = sidak_p_value(least, c.tiles);
  c.z2_p = std::isfinite(z2) ? chi_square_p_value(z2 * dof / c.tiles, dof) : 0;
  WelchTest mean = welch_test(a.total().estimate(), b.total().estimate(),
                              kRounding * std::abs(b.total().mean()));
  if (const size_t fewest = std::min(a.count(), b.count()); fewest < kFewImages && mean.error > 0)
    mean.p = student_p_value(mean.t, double(fewest - 1));
  c.mean_p = mean.p;
  c.p = sidak_p_value(std::min({c.tile_p, c.z2_p, c.mean_p}), kTests);
}

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
  Means& means = images_.emplace_back();
  for (size_t i = 0; i < kCount; ++i) {
    means[i] = sums[i] / counts[i];
    tiles_[i].add(means[i]);
    sum += means[i];
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
  std::vector<TestedTile> tested;
  std::vector<double> visible;
  for (int i = 0; i < kCount; ++i) {
    const double mean = b.tile(i).mean();
    if (mean > 0 && std::abs(a.tile(i).mean() / mean - 1) > std::abs(c.worst_ratio - 1))
      c.worst_ratio = a.tile(i).mean() / mean;
    WelchTest w = welch_test(a.tile(i).estimate(), b.tile(i).estimate(),
                             kNegligibleDifference * std::abs(b.total().mean()));
    if (w.error > 0 && fewest < kFewImages) {
      w.dof = double(fewest - 1);
      w.p = student_p_value(w.t, w.dof);
    }
    const double difference = a.tile(i).mean() - mean, rounding = kRounding * std::abs(mean);
    if (std::abs(difference) <= rounding && !(w.error > rounding)) continue;
    tested.push_back({i, w, mean, w.error});
  }
  c.tiles = int(tested.size());
  const double level = sidak(kTileSignificance, std::max(1, c.tiles));
  const double noticed_at = normal_quantile(level);
  constexpr double kPower80 = 0.8416;  // P(normal variate < this) = 0.8
  for (const TestedTile& t : tested) {
    const WelchTest& w = t.test;
    c.rejected += w.p < level;
    c.least_p = std::min(c.least_p, w.p);
    const double z = normal_of_student(w.t, w.dof);
    c.mean_z2 += std::min(z * z, kLargestZ2) / c.tiles;
    if (t.mean > 0)
      visible.push_back((student_of_normal(noticed_at, w.dof) + kPower80) * w.error / t.mean);
  }
  find_p_values(a, b, tested, c);
  if (!visible.empty()) {
    std::sort(visible.begin(), visible.end());
    c.visible_bias = visible[visible.size() / 2];
    c.visible_bias_worst = visible.back();
  }
  return c;
}

}  // namespace duet
