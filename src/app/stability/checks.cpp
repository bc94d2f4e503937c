#include "app/stability/checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace duet::stability {

namespace {

constexpr Check kChecks[] = {
    {"tiles", Unit::percent, 2.2,
     "root mean square deviation of the means of 8x8 tiles, without what noise adds to it; holds "
     "if Welch's test finds no tile that differs and the mean z^2 of the tiles is below {}",
     true, measure_tiles},
    {"pixels", Unit::percent, 0.02,
     "root mean square deviation of the pixels, without what noise adds to it; holds if no pixel "
     "differs and the standard error of pixels is below {}",
     true, measure_pixels},
    {"energy", Unit::percent, 0.005,
     "deviation of the mean of the image; holds if it is not significant and its standard error "
     "is below {}",
     true, measure_energy},
    {"region", Unit::percent, 1e-4,
     "mean of one part of the image, relative to the mean of another; holds if below {}", false,
     measure_region},
    {"paired", Unit::percent, 1e-3,
     "root mean square difference of images that were made with the same random numbers; holds "
     "if below {}",
     true, measure_paired},
    {"shrinking", Unit::number, 1,
     "order of the bias in the radius, from radii that halve from variant to variant; holds if at "
     "least {}",
     true, measure_shrinking},
    {"fireflies", Unit::percent, 0.05,
     "share of the light that is in the brightest thousandth of the pixels of images with one "
     "sample each; holds if below {}",
     false, measure_fireflies},
    {"spike", Unit::number, 50,
     "brightest pixel over the median of its neighbours; holds if below {}", false, measure_spike},
    {"noise", Unit::percent, 0.1,
     "relative root mean square noise of one image, without the worst thousandth of the pixels; "
     "holds if below {}",
     false, measure_noise},
    {"jump", Unit::number, 3,
     "greatest ratio of the variances of two variants that follow each other; holds if below {}",
     false, measure_jump},
    {"efficiency", Unit::number, 1,
     "1 / (relative mean square error x rays), over that of the reference; holds if at least {}",
     true, measure_efficiency},
    {"variance", Unit::number, 1.3,
     "variance of an image with N times the samples, times N, over that of one with the row's "
     "samples; holds if below {}",
     false, measure_variance},
    {"slope", Unit::number, -0.45,
     "slope of the error over the number of samples, both on log scales, without what the noise of "
     "the reference adds; holds if at most {}",
     true, measure_slope},
    {"slope-debiasing", Unit::number, 0.06,
     "by how much that slope changes with a noisy reference; holds if below {}", true,
     measure_slope_debiasing},
    {"bits", Unit::count, 0.5, "pixels that differ between 1, 2 and 7 threads; holds if none does",
     false, measure_bits},
    {"finite", Unit::count, 0.5,
     "pixels that are not finite or negative; holds if there is none, and at most a millionth of "
     "the samples was dropped",
     false, measure_finite},
    {"crowding", Unit::number, 4096,
     "photons merged per query, in the most crowded variant; holds if below {}", false,
     measure_crowding},
    {"stops", Unit::percent, 0.01,
     "deviation of the mean of images that were stopped after a random number of tiles; holds if "
     "it is not significant and its standard error is below {}",
     true, measure_stops},
};

}  // namespace

std::span<const Check> checks() {
  return kChecks;
}

const Check& find_check(const std::string& name) {
  return *std::find_if(std::begin(kChecks), std::end(kChecks),
                       [&](const Check& c) { return c.name == name; });
}

Measurement worst_variant(const Cell& cell,
                          const std::function<Measurement(const Variant&)>& measure) {
  Measurement worst;
  bool first = true, all_hold = true;
  for (const Variant& v : cell.row.variants) {
    Measurement m = measure(v);
    if (!v.label.empty()) m.detail = v.label + (m.detail.empty() ? "" : ", " + m.detail);
    all_hold &= m.holds;
    const bool worse =
        m.holds != worst.holds ? !m.holds : !(std::abs(m.value) <= std::abs(worst.value));
    if (first || worse) worst = std::move(m);
    first = false;
  }
  worst.holds = all_hold;
  return worst;
}

void require_finite(const Series& series, Measurement& m) {
  const double dropped = double(series.counters.nonfinite_samples) /
                         double(std::max<uint64_t>(1, series.counters.camera_paths));
  if (series.bad_pixels == 0 && dropped <= 1e-6) return;
  m.holds = false;
  m.detail += fmt::format("{}{} bad pixels, {:.2g} of the samples dropped",
                          m.detail.empty() ? "" : ", ", series.bad_pixels, dropped);
}

std::vector<std::vector<double>> tile_means(const Series& series, int grid_x, int grid_y) {
  const size_t tiles = size_t(grid_x) * size_t(grid_y);
  std::vector<std::vector<double>> all;
  for (const std::vector<float>& image : series.images) {
    std::vector<double> sums(tiles), counts(tiles);
    for (int y = 0; y < series.height; ++y)
      for (int x = 0; x < series.width; ++x) {
        const size_t tile =
            size_t(y * grid_y / series.height) * size_t(grid_x) + size_t(x * grid_x / series.width);
        sums[tile] += double(image[size_t(y) * size_t(series.width) + size_t(x)]);
        ++counts[tile];
      }
    for (size_t i = 0; i < tiles; ++i) sums[i] /= counts[i];
    all.push_back(std::move(sums));
  }
  return all;
}

std::vector<double> region_means(const Series& series, const Region& region) {
  const auto edge = [](double share, int size) { return int(std::lround(share * size)); };
  const int x0 = edge(region[0], series.width), y0 = edge(region[1], series.height);
  const int x1 = std::max(x0 + 1, edge(region[2], series.width));
  const int y1 = std::max(y0 + 1, edge(region[3], series.height));
  std::vector<double> means;
  for (const std::vector<float>& image : series.images) {
    double sum = 0;
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x)
        sum += double(image[size_t(y) * size_t(series.width) + size_t(x)]);
    means.push_back(sum / (double(x1 - x0) * (y1 - y0)));
  }
  return means;
}

std::vector<double> mean_image(const Series& series) {
  std::vector<double> mean(series.pixels());
  for (const std::vector<float>& image : series.images)
    for (size_t i = 0; i < mean.size(); ++i) mean[i] += double(image[i]);
  for (double& m : mean) m /= double(series.images.size());
  return mean;
}

}  // namespace duet::stability
