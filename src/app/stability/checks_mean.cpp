// Whether means are right: by tiles, by pixels, over the whole image or a part of it.
// Source of the tests: Jung, Hanika & Dachsbacher, "Detecting Bias in Monte Carlo Renderers using
// Welch's t-test", JCGT 9(2), 2020.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/stability/checks.h"

namespace duet::stability {

namespace {

/// Standard errors by which a tile has to be off to be noticed with 80 % probability, on top of
/// the quantile of the test. 0.84 is the normal quantile of 0.8.
constexpr double kPower = 0.84;
constexpr int kGrid = 8;

/// Deviations that methods which merge may have by their nature, as a share of a mean.
double margin(const Cell& cell) {
  return merges(cell.method) ? cell.row.margin : 0;
}

std::optional<double> exact_value(const Row& row, const Variant& variant) {
  return variant.value ? variant.value : row.reference.value;
}

/// The normal quantile that a two-sided test of this level needs, by bisection.
double critical(double level) {
  double low = 0, high = 40;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (std::erfc(middle / std::sqrt(2.0)) > level ? low : high) = middle;
  }
  return low;
}

std::vector<MeanEstimate> estimate_each(const std::vector<std::vector<double>>& batches) {
  std::vector<MeanEstimate> estimates;
  std::vector<double> values(batches.size());
  for (size_t i = 0; i < batches.front().size(); ++i) {
    for (size_t b = 0; b < batches.size(); ++b) values[b] = batches[b][i];
    estimates.push_back(estimate_mean(values));
  }
  return estimates;
}

/// Tiles of the subject against those of the reference.
struct GridComparison {
  double mean_z2 = 0;      ///< about 1 if the means are equal
  double least_p = 1;      ///< of all tiles
  double rms = 0;          ///< of the deviations, relative to the mean, without the noise
  double ratio = 1;        ///< of the means of the images
  double worst_error = 0;  ///< largest standard error of a tile, relative to the mean
  double typical_error = 0;
};

GridComparison compare(const std::vector<MeanEstimate>& a, const std::vector<MeanEstimate>& b,
                       double allowed) {
  GridComparison c;
  double sum_a = 0, sum_b = 0, square = 0, errors = 0;
  int noisy = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    sum_a += a[i].mean, sum_b += b[i].mean;
    const double error2 = a[i].error2 + b[i].error2, d = a[i].mean - b[i].mean;
    square += d * d - error2;
    errors += error2;
    c.worst_error = std::max(c.worst_error, std::sqrt(error2));
    const double slack = allowed * std::abs(b[i].mean);
    // Rounding is no deviation.
    const double p = welch_test(a[i], b[i], slack + 1e-5 * std::abs(b[i].mean)).p;
    c.least_p = std::min(c.least_p, p);
    if (!(error2 > 0)) continue;
    ++noisy;
    const double excess = std::max(0.0, std::abs(d) - slack);
    c.mean_z2 += excess * excess / error2;
  }
  if (noisy > 0) c.mean_z2 /= noisy;
  const double n = double(a.size()), mean = sum_b / n;
  c.ratio = sum_a / sum_b;
  c.rms = std::sqrt(std::max(0.0, square / n)) / mean;
  c.worst_error /= mean;
  c.typical_error = std::sqrt(errors / n) / mean;
  return c;
}

std::vector<MeanEstimate> reference_tiles(const Cell& cell, const Variant& v, const Series& like,
                                          int grid_x, int grid_y, Measurement& m) {
  if (const auto value = exact_value(cell.row, v))
    return std::vector<MeanEstimate>(size_t(grid_x) * size_t(grid_y), MeanEstimate{*value, 0, 0});
  const Series reference = render_reference(cell.laboratory, cell.row, cell.method, v);
  if (reference.width != like.width || reference.height != like.height)
    throw CatalogueError(cell.row.name + ": the reference has another size");
  require_finite(reference, m);
  return estimate_each(tile_means(reference, grid_x, grid_y));
}

}  // namespace

Measurement measure_tiles(const Cell& cell) {
  const double tests = double(cell.row.variants.size()) * kGrid * kGrid;
  const double level = sidak(cell.level, tests);
  return worst_variant(cell, [&](const Variant& v) {
    const Series& subject = cell.laboratory.render(subject_plan(cell.row, cell.method, v));
    Measurement m;
    const auto b = reference_tiles(cell, v, subject, kGrid, kGrid, m);
    const auto a = estimate_each(tile_means(subject, kGrid, kGrid));
    const GridComparison c = compare(a, b, margin(cell));
    m.value = c.rms;
    m.holds &= c.least_p > level && c.mean_z2 < cell.limit;
    m.detail = fmt::format("mean {:+.2f} %, z2 {:.2f}, p {:.1g}, notices {:.1f} % of a tile",
                           100 * (c.ratio - 1), c.mean_z2, c.least_p,
                           100 * c.typical_error * (critical(level) + kPower));
    require_finite(subject, m);
    return m;
  });
}

Measurement measure_pixels(const Cell& cell) {
  return worst_variant(cell, [&](const Variant& v) {
    const Series& subject = cell.laboratory.render(subject_plan(cell.row, cell.method, v));
    const double level = sidak(cell.level, double(cell.row.variants.size() * subject.pixels()));
    Measurement m;
    const auto b = reference_tiles(cell, v, subject, subject.width, subject.height, m);
    const auto a = estimate_each(tile_means(subject, subject.width, subject.height));
    const GridComparison c = compare(a, b, margin(cell));
    m.value = c.rms;
    m.holds &= c.least_p > level && c.worst_error < cell.limit;
    m.detail = fmt::format("mean {:+.2f} %, p {:.1g}, standard error of a pixel {:.1g} %",
                           100 * (c.ratio - 1), c.least_p, 100 * c.typical_error);
    require_finite(subject, m);
    return m;
  });
}

Measurement compare_energy(const Cell& cell, const Series& subject, const Variant& v) {
  Measurement m;
  const MeanEstimate a = estimate_mean(region_means(subject, cell.row.region));
  MeanEstimate b;
  if (const auto value = exact_value(cell.row, v)) {
    b.mean = *value;
  } else {
    const Series reference = render_reference(cell.laboratory, cell.row, cell.method, v);
    require_finite(reference, m);
    b = estimate_mean(region_means(reference, cell.row.region));
  }
  m.value = a.mean / b.mean - 1;
  m.error = std::sqrt(a.error2 + b.error2) / std::abs(b.mean);
  const double slack = merges(cell.method) ? cell.limit * std::abs(b.mean) : 0;
  const double p = welch_test(a, b, slack + 1e-5 * std::abs(b.mean)).p;
  m.holds &= p > sidak(cell.level, double(cell.row.variants.size())) && m.error < cell.limit;
  require_finite(subject, m);
  return m;
}

Measurement measure_energy(const Cell& cell) {
  return worst_variant(cell, [&](const Variant& v) {
    return compare_energy(cell, cell.laboratory.render(subject_plan(cell.row, cell.method, v)), v);
  });
}

Measurement measure_region(const Cell& cell) {
  return worst_variant(cell, [&](const Variant& v) {
    const Series& s = cell.laboratory.render(subject_plan(cell.row, cell.method, v));
    const double part = estimate_mean(region_means(s, cell.row.region)).mean;
    const double whole = estimate_mean(region_means(s, cell.row.over)).mean;
    Measurement m;
    m.value = part / whole;
    m.holds = m.value < cell.limit;
    require_finite(s, m);
    return m;
  });
}

Measurement measure_paired(const Cell& cell) {
  return worst_variant(cell, [&](const Variant& v) {
    const Series& a = cell.laboratory.render(subject_plan(cell.row, cell.method, v));
    const Series b = render_reference(cell.laboratory, cell.row, cell.method, v);
    Measurement m;
    double squares = 0, sum = 0, difference = 0;
    for (size_t n = 0; n < a.images.size(); ++n)
      for (size_t i = 0; i < a.images[n].size(); ++i) {
        const double x = double(a.images[n][i]), y = double(b.images[n][i]);
        squares += (x - y) * (x - y), sum += y, difference += x - y;
      }
    const double count = double(a.images.size() * a.pixels());
    m.value = std::sqrt(squares / count) / (sum / count);
    m.holds = m.value < cell.limit;
    m.detail = fmt::format("mean {:+.4f} %", 100 * difference / sum);
    require_finite(a, m);
    return m;
  });
}

Measurement measure_shrinking(const Cell& cell) {
  Measurement m;
  std::vector<double> biases;
  for (const Variant& v : cell.row.variants) {
    const Series& subject = cell.laboratory.render(subject_plan(cell.row, cell.method, v));
    const auto b = reference_tiles(cell, v, subject, kGrid, kGrid, m);
    const auto a = estimate_each(tile_means(subject, kGrid, kGrid));
    const GridComparison c = compare(a, b, 0);
    biases.push_back(c.rms);
    m.detail += fmt::format("{}{:.2f} %", biases.size() > 1 ? ", " : "bias ", 100 * c.rms);
    require_finite(subject, m);
  }
  const double halvings = double(biases.size() - 1);
  // A bias that is lost in the noise has shrunk by as much as can be seen.
  m.value = std::log2(biases.front() / std::max(biases.back(), 1e-4)) / halvings;
  m.holds &= m.value >= cell.limit;
  return m;
}

}  // namespace duet::stability
