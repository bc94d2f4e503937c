#include "support/agreement.h"

#include <algorithm>
#include <cmath>

#include "math/vector.h"
#include "support/statistics.h"

namespace duet::test {

namespace {

/// Sums over tiles of what `value` makes of a pixel, given its first channel.
template <class Value>
std::vector<double> tile_sums(const Image& image, const Value& value) {
  constexpr int kTiles = TileBatches::kTiles;
  std::vector<double> sums(kTiles * kTiles);
  const size_t stride = image.channels.size();
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      sums[size_t((y * kTiles / image.height) * kTiles + x * kTiles / image.width)] +=
          value(&image.data[(size_t(y) * size_t(image.width) + size_t(x)) * stride]);
  return sums;
}

double grey(const float* p) {
  return (double(p[0]) + double(p[1]) + double(p[2])) / 3;
}

std::vector<double> tile_means(const Image& image) {
  std::vector<double> means = tile_sums(image, grey);
  const std::vector<double> counts = tile_sums(image, [](const float*) { return 1.0; });
  for (size_t i = 0; i < means.size(); ++i) means[i] /= counts[i];
  return means;
}

}  // namespace

void TileBatches::add(const Image& image) {
  batches_.push_back(tile_means(image));
}

double TileBatches::mean(int tile) const {
  double sum = 0;
  for (const auto& b : batches_) sum += b[size_t(tile)];
  return sum / double(batches_.size());
}

double TileBatches::error2(int tile) const {
  Moments m;
  for (const auto& b : batches_) m.add(b[size_t(tile)]);
  return m.error() * m.error();
}

double TileBatches::total() const {
  double sum = 0;
  for (int i = 0; i < kTiles * kTiles; ++i) sum += mean(i);
  return sum / (kTiles * kTiles);
}

ReferenceTiles::ReferenceTiles(const Image& mean, const Image& variance, double spp)
    : means(tile_means(mean)) {
  error2 = tile_sums(variance, [](const float* p) {
    return sqr((std::sqrt(double(p[0])) + std::sqrt(double(p[1])) + std::sqrt(double(p[2]))) / 3);
  });
  const std::vector<double> counts = tile_sums(variance, [](const float*) { return 1.0; });
  for (size_t i = 0; i < error2.size(); ++i) error2[i] /= sqr(counts[i]) * spp;
}

namespace {

/// A tile of what is compared with, and how little is known of its error: its square over the
/// degrees of freedom.
struct Expected {
  double mean, error2, doubt;
};

template <class F>
TileComparison compare(const TileBatches& a, const F& expected) {
  TileComparison c;
  double total = 0;
  for (int i = 0; i < TileBatches::kTiles * TileBatches::kTiles; ++i) {
    const Expected b = expected(i);
    total += b.mean / (TileBatches::kTiles * TileBatches::kTiles);
    const double va = a.error2(i), both = va + b.error2;
    if (b.mean > 0 && std::abs(a.mean(i) / b.mean - 1) > std::abs(c.worst_ratio - 1))
      c.worst_ratio = a.mean(i) / b.mean;
    if (!(both > 0)) continue;
    ++c.tiles;
    const double t = (a.mean(i) - b.mean) / std::sqrt(both);
    c.mean_z2 += t * t;
    // Welch & Satterthwaite's degrees of freedom, and Wallace's map of t to a normal variate.
    const double dof = both * both / (va * va / double(a.count() - 1) + b.doubt);
    const double z = (8 * dof + 1) / (8 * dof + 3) * std::sqrt(dof * std::log1p(t * t / dof));
    c.least_p = std::min(c.least_p, normal_p_value(z));
  }
  c.ratio = a.total() / total;
  if (c.tiles > 0) c.mean_z2 /= c.tiles;
  return c;
}

}  // namespace

TileComparison compare_tiles(const TileBatches& a, const TileBatches& b) {
  return compare(a, [&](int i) {
    const double error2 = b.error2(i);
    return Expected{b.mean(i), error2, error2 * error2 / double(b.count() - 1)};
  });
}

TileComparison compare_tiles(const TileBatches& a, const ReferenceTiles& b) {
  return compare(a, [&](int i) { return Expected{b.means[size_t(i)], b.error2[size_t(i)], 0}; });
}

}  // namespace duet::test
