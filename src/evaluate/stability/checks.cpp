#include "evaluate/stability/checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace duet::stability {

namespace {

constexpr const char* kOfMean = "deviation of that mean, as a share of it";
constexpr const char* kOfValue = "value that would have been found beyond the limit";
constexpr const char* kExact =
    "exact: the same program always gives the same number, and any beyond "
    "the limit fails";

constexpr Check kChecks[] = {
    {"tiles", Unit::percent,
     "root mean square deviation of the means of tiles (4x4 unless the row says otherwise), "
     "without "
     "what noise adds to it; holds if Welch's test finds no tile that differs and the mean z^2 of "
     "the tiles is below the limit",
     "deviation of any one tile, as a share of its mean, or of a quarter of the image's if that is "
     "more",
     "a mean z² of {}", 3.4, 0.05, true, measure_tiles},
    {"pixels", Unit::percent,
     "root mean square deviation of the pixels, without what noise adds to it; holds if no pixel "
     "differs",
     "deviation of any one pixel, as a share of its mean, or of a quarter of the image's if that "
     "is "
     "more",
     nullptr, 0, 0.05, true, measure_pixels},
    {"energy", Unit::percent, "deviation of the mean of the image; holds if it is not significant",
     kOfMean, nullptr, 0, 0.005, true, measure_energy},
    {"region", Unit::percent, "mean of one part of the image, relative to the mean of another",
     kOfValue, "below {}", 1e-4, std::nullopt, false, measure_region},
    {"paired", Unit::percent,
     "root mean square difference of images that were made with the same random numbers", kExact,
     "below {}", 1e-3, std::nullopt, true, measure_paired},
    {"shrinking", Unit::number,
     "order of the bias in the radius, from radii that halve from variant to variant", kOfValue,
     "at least {}", 1, std::nullopt, true, measure_shrinking},
    {"fireflies", Unit::percent,
     "share of the light that is in the brightest thousandth of the pixels of images with one "
     "sample each",
     kOfValue, "below {}", 0.05, std::nullopt, false, measure_fireflies},
    {"spike", Unit::number, "brightest pixel of all images over the median of its neighbours",
     kExact, "below {}", 50, std::nullopt, false, measure_spike},
    {"noise", Unit::percent,
     "relative root mean square noise of one image, without the worst thousandth of the pixels",
     kOfValue, "below {}", 0.1, std::nullopt, false, measure_noise},
    {"jump", Unit::number, "greatest ratio of the variances of two variants that follow each other",
     kOfValue, "below {}", 3, std::nullopt, false, measure_jump},
    {"efficiency", Unit::number,
     "1 / (relative mean square error x rays), over that of the reference", kOfValue, "at least {}",
     1, std::nullopt, true, measure_efficiency},
    {"variance", Unit::number,
     "variance of an image with N times the samples, times N, over that of one with the row's "
     "samples",
     kOfValue, "below {}", 1.3, std::nullopt, false, measure_variance},
    {"slope", Unit::number,
     "slope of the error over the number of samples, both on log scales, without what the noise of "
     "the reference adds",
     kOfValue, "at most {}", -0.45, std::nullopt, true, measure_slope},
    {"slope-debiasing", Unit::number, "by how much that slope changes with a noisy reference",
     kOfValue, "below {}", 0.06, std::nullopt, true, measure_slope_debiasing},
    {"bits", Unit::count, "pixels that differ between 1, 2 and 7 threads",
     "exact: one pixel of one bit fails", "below {}", 1, std::nullopt, false, measure_bits},
    {"finite", Unit::count,
     "pixels that are not finite or negative; fails, too, if more than a millionth of the samples "
     "was dropped",
     "exact: one pixel fails", "below {}", 1, std::nullopt, false, measure_finite},
    {"crowding", Unit::number, "photons merged per query, in the most crowded variant", kExact,
     "below {}", 4096, std::nullopt, false, measure_crowding},
    {"stops", Unit::percent,
     "deviation of the mean of images that were stopped after a random number of tiles; holds if "
     "it is not significant",
     kOfMean, nullptr, 0, 0.01, true, measure_stops},
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
  Power weakest;
  bool first = true, all_hold = true;
  for (const Variant& v : cell.row.variants) {
    Measurement m = measure(v);
    if (!v.label.empty()) m.detail = v.label + (m.detail.empty() ? "" : ", " + m.detail);
    all_hold &= m.holds;
    weakest = first ? m.power : weaker(weakest, m.power);
    const bool worse =
        m.holds != worst.holds ? !m.holds : !(std::abs(m.value) <= std::abs(worst.value));
    if (first || worse) worst = std::move(m);
    first = false;
  }
  worst.holds = all_hold;
  worst.power = weakest;
  return worst;
}

Measurement measure_resolved(const Cell& cell, const std::function<Measurement(int)>& measure) {
  Measurement m;
  grow_images(cell.row.batches, cell.row.most_batches, [&](int batches) {
    cell.laboratory.check_cancelled();
    m = measure(batches);
    return cell.known_to_fail && !m.holds ? 0 : m.power.noise;
  });
  return m;
}

Measurement worst_resolved_variant(const Cell& cell,
                                   const std::function<Measurement(const Variant&, int)>& measure) {
  return worst_variant(cell, [&](const Variant& v) {
    return measure_resolved(cell, [&](int batches) { return measure(v, batches); });
  });
}

Series render_subject(const Cell& cell, const Variant& variant, int batches) {
  SeriesPlan plan = subject_plan(cell.row, cell.method, variant);
  plan.batches = batches;
  return cell.laboratory.render(plan);
}

void require_finite(const Series& series, Measurement& m) {
  const RenderCounters counters = series.counters();
  const double dropped =
      double(counters.nonfinite_samples) / double(std::max<uint64_t>(1, counters.camera_paths));
  const long bad_pixels = series.bad_pixels();
  if (bad_pixels == 0 && dropped <= 1e-6) return;
  m.holds = false;
  m.detail += fmt::format("{}{} bad pixels, {:.2g} of the samples dropped",
                          m.detail.empty() ? "" : ", ", bad_pixels, dropped);
}

std::vector<std::vector<double>> tile_means(const Series& series, int grid_x, int grid_y) {
  const size_t tiles = size_t(grid_x) * size_t(grid_y);
  std::vector<std::vector<double>> all;
  for (const Picture& picture : series.pictures) {
    const std::vector<float>& image = picture.grey;
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
  for (const Picture& picture : series.pictures) {
    const std::vector<float>& image = picture.grey;
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
  for (const Picture& picture : series.pictures)
    for (size_t i = 0; i < mean.size(); ++i) mean[i] += double(picture.grey[i]);
  for (double& m : mean) m /= double(series.pictures.size());
  return mean;
}

int jackknife_groups(size_t images) {
  constexpr size_t kGroups = 32;
  return int(std::min(images, kGroups));
}

}  // namespace duet::stability
