#include "integrators/sample_allocation.h"

#include <algorithm>
#include <cmath>

#include "math/statistics.h"

namespace duet {

namespace {

/// How far below and above their mean the rates of tiles may be: a few samples may miss what makes
/// noise, but do not make up what they see.
constexpr double kLeastRate = 0.25, kLargestRate = 16;
/// The largest where passes also trace light sub-paths: there are as many of those as the tile
/// with the most samples has.
constexpr double kLargestRateWithSplats = 4;
/// Share of the image's mean variance that every tile is taken to have, for what has not been seen.
constexpr double kUnseenVariance = 0.05;

/// Mean variance of the pixels of tile `k` among the films, of a mean of their samples.
double tile_variance(std::span<const Film> films, size_t k) {
  const FilmTile& tile = films[0].tiles()[k];
  const PixelBounds own = tile.stored().intersect(tile.sampled());
  double sum = 0, pixels = 0;
  for (int y = own.y0; y < own.y1; ++y)
    for (int x = own.x0; x < own.x1; ++x) {
      const size_t at = tile.index(x, y);
      for (size_t c = 1; c <= 3; ++c) {
        Moments means;
        for (const Film& f : films) {
          const ExactSum* s = &f.tiles()[k].sums()[at];
          const double weight = s[0].value();
          means.add(weight != 0 ? s[c].value() / weight : 0);
        }
        sum += means.variance();
      }
      pixels += 1;
    }
  return pixels > 0 ? sum / (3 * pixels) : 0;
}

}  // namespace

std::vector<double> tile_rates(std::span<const Film> films) {
  const size_t tiles = films[0].tiles().size();
  std::vector<double> deviation(tiles), area(tiles);
  double mean = 0, pixels = 0;
  for (size_t k = 0; k < tiles; ++k) {
    const PixelBounds& b = films[0].tiles()[k].sampled();
    area[k] = double(b.width()) * b.height();
    deviation[k] = tile_variance(films, k);
    mean += area[k] * deviation[k];
    pixels += area[k];
  }
  if (!(mean > 0)) return std::vector<double>(tiles, 1.0);
  for (double& d : deviation) d = std::sqrt(d + kUnseenVariance * mean / pixels);
  const double largest = films[0].splat_layer_count() > 0 ? kLargestRateWithSplats : kLargestRate;
  const auto rate = [&](size_t k, double scale) {
    return std::clamp(scale * deviation[k], kLeastRate, largest);
  };
  // The scale at which the mean of the rates is one, by bisection of its logarithm.
  const auto [least, most] = std::minmax_element(deviation.begin(), deviation.end());
  double low = std::log(1 / *most), high = std::log(1 / *least);
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    double sum = 0;
    for (size_t k = 0; k < tiles; ++k) sum += area[k] * rate(k, std::exp(middle));
    (sum < pixels ? low : high) = middle;
  }
  std::vector<double> rates(tiles);
  for (size_t k = 0; k < tiles; ++k) rates[k] = rate(k, std::exp(low));
  return rates;
}

SampleAllocation::SampleAllocation(std::span<const Film> films, AllocatedSamples before)
    : films_(films), allocated_(std::move(before)) {
  allocated_.taken.resize(films.size());
}

void SampleAllocation::spread() {
  const size_t half = films_.size() / 2;
  allocated_.even = allocated_.taken[0].samples;
  allocated_.rates = {tile_rates(films_.subspan(half)), tile_rates(films_.first(half))};
}

void SampleAllocation::next(size_t film, uint32_t count, SampleRange& range) {
  AllocatedSamples::Taken& taken = allocated_.taken[film];
  range.first = taken.passes;
  range.count = count;
  range.tiles = {};
  if (is_spread()) {
    const std::vector<double>& rates = allocated_.rates[film < films_.size() / 2 ? 0 : 1];
    tiles_.resize(rates.size());
    range.count = 0;
    const double even = allocated_.even;
    const double before = taken.samples - even, after = before + count;
    for (size_t k = 0; k < rates.size(); ++k) {
      const auto total = [&](double s) { return uint32_t(std::lround(even + rates[k] * s)); };
      tiles_[k] = {total(before), total(after) - total(before)};
      range.count = std::max(range.count, tiles_[k].count);
    }
    range.tiles = tiles_;
  }
  taken.samples += count;
  taken.passes += range.count;
}

}  // namespace duet
