#include "image/bias_test.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <vector>

#include "image/colours.h"
#include "math/statistics.h"

namespace duet {

namespace {

constexpr int kTiles = 8;            // on a side
constexpr int kLeastPixels = 4;      // of a tile, on a side
constexpr int kLeastForBlocks = 12;  // of a tile whose blocks tell how pixels hang together
constexpr int kLargestBlock = 8;     // pixels on a side; reconstruction filters reach less far
/// Student's distribution with more degrees of freedom is taken as that with so many.
constexpr double kLargestDof = 1000;
/// The systematic error of a pixel is relative to its reference and this share of the mean.
constexpr double kDarkShare = 0.01;
/// Tiles below this share of the mean brightness do not count for the statement of power.
constexpr double kDimTile = 0.1;
/// Variances from here on may be clipped: the largest half.
constexpr double kUnknownVariance = 65504;
constexpr double kPower80 = 0.8416;  // P(normal variate < this) = 0.8

/// Differences d of a group of pixels, with the reference b and the variance of d.
struct Sums {
  double d = 0, b = 0, variance = 0;
};

/// The variance of the sum of d as the spread of its parts about a common ratio to b shows it: the
/// squares of leave-one-out residuals. Source: MacKinnon & White, "Some heteroskedasticity-
/// consistent covariance matrix estimators", J. Econometrics 29, 1985 (HC3).
double spread(std::span<const Sums> parts) {
  double d = 0, b = 0;
  for (const Sums& s : parts) d += s.d, b += std::max(s.b, 0.0);
  double sum = 0;
  for (const Sums& s : parts) {
    const double share = b > 0 ? std::max(s.b, 0.0) / b : 1 / double(parts.size());
    const double residual = (s.d - share * d) / std::max(1 - share, 1e-3);
    sum += residual * residual;
  }
  return sum;
}

/// One channel of one tile.
struct TileSums : Sums {
  int x = 0, y = 0, width = 0, height = 0, channel = 0;
  long pixels = 0;
  double spread = 0, block_spread = 0;  ///< of pixels, of blocks
};

/// Both variances of a sum, with what is systematic, and the degrees of freedom of the second.
struct Errors {
  double predicted = 0, seen = 0, dof = 1;
};

double p_value(double difference, const Errors& e) {
  if (difference == 0) return 1;
  const double z = e.predicted > 0 ? normal_p_value(difference / std::sqrt(e.predicted)) : 0;
  const double t = e.seen > 0 ? student_p_value(difference / std::sqrt(e.seen), e.dof) : 0;
  return std::max(z, t);
}

/// The difference that a test at some level notices with a probability of 80 %.
class Power {
 public:
  explicit Power(double level) : z_(normal_quantile(level)) {}
  double noticed(const Errors& e) {
    // Most tiles have as many pixels as the last one.
    if (e.dof != dof_) dof_ = e.dof, t_ = student_of_normal(z_, dof_);
    return std::max((z_ + kPower80) * std::sqrt(e.predicted), (t_ + kPower80) * std::sqrt(e.seen));
  }

 private:
  double z_, dof_ = 0, t_ = 0;
};

class Tester {
 public:
  Tester(const Image& image, const Image& reference, const NoiseModel& noise)
      : a_(image),
        b_(reference),
        v_(*noise.variance),
        width_(image.width),
        systematic_(noise.systematic),
        per_sample_(1 / noise.image_spp + 1 / noise.reference_spp) {
    usable_.resize(a_.pixels());
    for (size_t i = 0; i < usable_.size(); ++i) left_out_ += !(usable_[i] = usable(i));
    tiles_ = divide(kLeastPixels);
    for (int c = 0; c < 3; ++c) {
      double sum = 0, pixels = 0;
      for (const TileSums& t : channel(c)) sum += t.b, pixels += double(t.pixels);
      means_[size_t(c)] = pixels > 0 ? sum / pixels : 0;
    }
    find_correlation();
  }

  BiasTest run() const {
    BiasTest test;
    test.left_out = left_out_;
    if (tiles_.empty()) return test;
    test.tests = int(tiles_.size()) + 6;
    test.correlation = correlation_;
    Power power(sidak(kBiasSignificance, test.tests));
    test_tiles(test, power);
    for (int c = 0; c < 3; ++c) test_mean(c, test, power);
    test.p = sidak_p_value(std::min(test.tile.p, test.mean.p), test.tests);
    return test;
  }

 private:
  bool usable(size_t pixel) const {
    for (int c = 0; c < 3; ++c)
      if (!(std::isfinite(a_(pixel, c)) && std::isfinite(b_(pixel, c)) &&
            v_(pixel, c) < kUnknownVariance))
        return false;
    return true;
  }

  /// All channels of 8×8 tiles, or of fewer that have at least so many pixels on a side.
  std::vector<TileSums> divide(int least) const {
    const int height = int(a_.pixels()) / width_;
    const int columns = std::clamp(width_ / least, 1, kTiles);
    const int rows = std::clamp(height / least, 1, kTiles);
    std::vector<TileSums> tiles;
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        TileSums tile;
        tile.x = column * width_ / columns, tile.y = row * height / rows;
        tile.width = (column + 1) * width_ / columns - tile.x;
        tile.height = (row + 1) * height / rows - tile.y;
        for (tile.channel = 0; tile.channel < 3; ++tile.channel)
          if (TileSums sums = summed(tile); sums.pixels > 1) tiles.push_back(sums);
      }
    return tiles;
  }

  TileSums summed(TileSums tile) const {
    const int side = std::clamp((std::min(tile.width, tile.height) + 1) / 3, 1, kLargestBlock);
    const int across = (tile.width + side - 1) / side, down = (tile.height + side - 1) / side;
    std::vector<Sums> pixels;
    pixels.reserve(size_t(tile.width) * size_t(tile.height));
    std::vector<Sums> blocks(size_t(across) * size_t(down));
    for (int y = 0; y < tile.height; ++y)
      for (int x = 0; x < tile.width; ++x) {
        const size_t i = size_t(tile.y + y) * size_t(width_) + size_t(tile.x + x);
        if (!usable_[i]) continue;
        const double b = b_(i, tile.channel), d = a_(i, tile.channel) - b;
        const double variance = std::max(0.0, v_(i, tile.channel)) * per_sample_;
        pixels.push_back({d, b, variance});
        Sums& block = blocks[size_t(y / side) * size_t(across) + size_t(x / side)];
        block.d += d, block.b += b;
        tile.d += d, tile.b += b, tile.variance += variance;
      }
    tile.pixels = long(pixels.size());
    tile.spread = spread(pixels);
    tile.block_spread = spread(blocks);
    return tile;
  }

  /// Pixels that share samples have sums of greater variance than their own variances add up to;
  /// blocks of pixels show by how much, if they are larger than what shares samples. The middle one
  /// of the tiles, so that a defect of some has no say.
  void find_correlation() {
    std::vector<double> ratios;
    for (const TileSums& t : divide(kLeastForBlocks))
      if (t.variance > 0 && t.spread > 0) ratios.push_back(t.block_spread / t.spread);
    if (ratios.empty()) return;
    const auto middle = ratios.begin() + std::ptrdiff_t(ratios.size() / 2);
    std::nth_element(ratios.begin(), middle, ratios.end());
    correlation_ = std::max(1.0, *middle);
  }

  std::vector<TileSums> channel(int c) const {
    std::vector<TileSums> list;
    for (const TileSums& t : tiles_)
      if (t.channel == c) list.push_back(t);
    return list;
  }

  Errors errors(const TileSums& t) const {
    const double margin =
        systematic_ * (std::abs(t.b) + kDarkShare * means_[size_t(t.channel)] * double(t.pixels));
    return {correlation_ * t.variance + margin * margin, correlation_ * t.spread + margin * margin,
            std::min(double(t.pixels - 1), kLargestDof)};
  }

  void test_tiles(BiasTest& test, Power& power) const {
    std::vector<double> visible;
    const TileSums* last = nullptr;
    for (const TileSums& t : tiles_) {
      const Errors e = errors(t);
      if (const double p = p_value(t.d, e); p < test.tile.p)
        test.tile = {t.x, t.y, t.width, t.height, t.channel, p, t.b > 0 ? 1 + t.d / t.b : 1};
      const double bright = kDimTile * means_[size_t(t.channel)] * double(t.pixels);
      if (!(t.b > bright)) continue;
      const double relative = power.noticed(e) / t.b;
      // The three channels of a tile follow one another: the surest of them notices.
      if (last && last->x == t.x && last->y == t.y)
        visible.back() = std::min(visible.back(), relative);
      else
        visible.push_back(relative);
      last = &t;
    }
    if (visible.empty()) return;
    std::sort(visible.begin(), visible.end());
    test.noticed_tile = visible[visible.size() / 2];
    test.noticed_tile_worst = visible.back();
  }

  /// The sum over all tiles as it is, and weighted as is best for a bias that is everywhere the
  /// same share of the light: by light over variance.
  void test_mean(int c, BiasTest& test, Power& power) const {
    const std::vector<TileSums> tiles = channel(c);
    for (const bool weighted : {false, true}) {
      std::vector<Sums> parts;
      Sums all;
      for (const TileSums& t : tiles) {
        const Errors e = errors(t);
        const double w = !weighted ? 1 : e.predicted > 0 ? std::max(t.b, 0.0) / e.predicted : 0;
        parts.push_back({w * t.d, w * t.b, 0});
        all.d += w * t.d, all.b += w * t.b, all.variance += w * w * correlation_ * t.variance;
      }
      const double margin2 = systematic_ * all.b * systematic_ * all.b;
      const Errors e{all.variance + margin2, spread(parts) + margin2,
                     std::max(1.0, double(parts.size()) - 1)};
      if (!(all.b > 0)) continue;
      if (!weighted) {
        test.ratio[size_t(c)] = 1 + all.d / all.b;
        test.ratio_error[size_t(c)] = std::sqrt(std::max(e.predicted, e.seen)) / all.b;
      } else {
        const double relative = power.noticed(e) / all.b;
        test.noticed_mean =
            test.noticed_mean > 0 ? std::min(test.noticed_mean, relative) : relative;
      }
      const double p = tiles.size() > 1 ? p_value(all.d, e) : 1;
      if (p < test.mean.p)
        test.mean = {0, 0, width_, int(a_.pixels()) / width_, c, p, 1 + all.d / all.b};
    }
  }

  Colours a_, b_, v_;
  int width_;
  double systematic_, per_sample_, correlation_ = 1;
  std::vector<bool> usable_;
  long left_out_ = 0;
  std::array<double, 3> means_{};
  std::vector<TileSums> tiles_;
};

}  // namespace

double BiasTest::bound95() const {
  double bound = 0;
  for (size_t c = 0; c < 3; ++c)
    bound = std::max(bound, std::abs(ratio[c] - 1) + 1.96 * ratio_error[c]);
  return bound;
}

BiasTest test_bias(const Image& image, const Image& reference, const NoiseModel& noise) {
  const auto size = [](const Image& i) { return std::pair(i.width, i.height); };
  if (size(image) != size(reference) || size(image) != size(*noise.variance))
    throw std::invalid_argument("the image, the reference and the variance differ in size");
  return Tester(image, reference, noise).run();
}

}  // namespace duet
