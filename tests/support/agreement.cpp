#include "support/agreement.h"

#include <algorithm>
#include <cmath>

#include "support/statistics.h"

namespace duet::test {

void TileBatches::add(const Image& image) {
  std::vector<double> sums(kTiles * kTiles), counts(kTiles * kTiles);
  const size_t stride = image.channels.size();
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const size_t tile = size_t((y * kTiles / image.height) * kTiles + x * kTiles / image.width);
      const float* p = &image.data[(size_t(y) * size_t(image.width) + size_t(x)) * stride];
      sums[tile] += double(p[0]) + double(p[1]) + double(p[2]);
      counts[tile] += 3;
    }
  for (size_t i = 0; i < sums.size(); ++i) sums[i] /= counts[i];
  batches_.push_back(std::move(sums));
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

TileComparison compare_tiles(const TileBatches& a, const TileBatches& b) {
  TileComparison c;
  c.ratio = a.total() / b.total();
  for (int i = 0; i < TileBatches::kTiles * TileBatches::kTiles; ++i) {
    const double va = a.error2(i), vb = b.error2(i), difference = a.mean(i) - b.mean(i);
    if (b.mean(i) > 0 && std::abs(a.mean(i) / b.mean(i) - 1) > std::abs(c.worst_ratio - 1))
      c.worst_ratio = a.mean(i) / b.mean(i);
    if (!(va + vb > 0)) continue;
    ++c.tiles;
    const double t = difference / std::sqrt(va + vb);
    c.mean_z2 += t * t;
    // Welch & Satterthwaite's degrees of freedom, and Wallace's map of t to a normal variate.
    const double dof =
        (va + vb) * (va + vb) / (va * va / double(a.count() - 1) + vb * vb / double(b.count() - 1));
    const double z = (8 * dof + 1) / (8 * dof + 3) * std::sqrt(dof * std::log1p(t * t / dof));
    c.least_p = std::min(c.least_p, normal_p_value(z));
  }
  if (c.tiles > 0) c.mean_z2 /= c.tiles;
  return c;
}

}  // namespace duet::test
