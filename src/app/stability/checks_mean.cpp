// Whether means are right: by tiles, by pixels, over the whole image or a part of it.
// Source of the tests: Jung, Hanika & Dachsbacher, "Detecting Bias in Monte Carlo Renderers using
// Welch's t-test", JCGT 9(2), 2020.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "app/stability/checks.h"

namespace duet::stability {

namespace {

/// Tiles darker than this share of the mean of the image are judged relative to that much of it: of
/// what is nearly black nobody needs a hundredth.
constexpr double kDark = 0.25;
/// A reference is made with so many images that its own noise is no more than this share of what
/// the comparison may have.
constexpr double kReferenceNoise = 0.5;

/// How means are compared.
struct Rule {
  double level;       ///< of significance, for one mean
  double margin;      ///< relative deviation that does not count
  double resolution;  ///< relative deviation that has to be noticed where there is no margin
  double coarser;     ///< see Cell
  double required() const { return margin > 0 ? std::max(2 * margin, resolution) : resolution; }
  double allowed_noise() const { return coarser * (required() - margin); }
};

/// The means of the tiles of each image, or whatever is compared.
using Means = std::function<std::vector<std::vector<double>>(const Series&)>;

std::optional<double> exact_value(const Row& row, const Variant& variant) {
  return variant.value ? variant.value : row.reference.value;
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

double mean_of(const std::vector<MeanEstimate>& estimates) {
  double sum = 0;
  for (const MeanEstimate& e : estimates) sum += e.mean;
  return sum / double(estimates.size());
}

/// Tiles of the subject against those of the reference.
struct GridComparison {
  double mean_z2 = 0;  ///< of the deviations as normal variates: about 1 if the means are equal
  double least_p = 1;  ///< of all tiles
  double rms = 0;      ///< of the deviations, relative to the mean, without the noise
  double ratio = 1;    ///< of the means of the images
  double error2 = 0;   ///< mean squared standard error of a tile, relative to the mean's square
  double error4 = 0;   ///< mean of its square
  Power power;         ///< of the least certain tile
};

GridComparison compare(const std::vector<MeanEstimate>& a, const std::vector<MeanEstimate>& b,
                       const Rule& rule) {
  GridComparison c;
  const double n = double(a.size()), mean = std::abs(mean_of(b));
  double square = 0;
  int noisy = 0;
  c.power.required = rule.margin + rule.allowed_noise();
  for (size_t i = 0; i < a.size(); ++i) {
    const double error2 = a[i].error2 + b[i].error2, d = a[i].mean - b[i].mean;
    square += d * d - error2;
    c.error2 += error2 / n / (mean * mean);
    c.error4 += error2 * error2 / n / std::pow(mean, 4);
    const double slack = rule.margin * std::abs(b[i].mean);
    // Rounding is no deviation.
    const WelchTest test = welch_test(a[i], b[i], slack + 1e-5 * std::abs(b[i].mean));
    c.least_p = std::min(c.least_p, test.p);
    const double scale = std::max(std::abs(b[i].mean), kDark * mean);
    const double noise = noticed_difference(test.error, test.dof, rule.level) / scale;
    c.power.noticed = std::max(c.power.noticed, slack / scale + noise);
    c.power.noise = std::max(c.power.noise, noise / rule.allowed_noise());
    if (!(error2 > 0)) continue;
    ++noisy;
    const double z = normal_of_student(test.t, test.dof);
    c.mean_z2 += z * z;
  }
  if (noisy > 0) c.mean_z2 /= noisy;
  c.ratio = mean_of(a) / mean_of(b);
  c.rms = std::sqrt(std::max(0.0, square / n)) / mean;
  return c;
}

/// What the images of a series are compared with.
std::vector<MeanEstimate> reference_means(const Cell& cell, const Variant& v, const Series& like,
                                          const Means& means, Rule rule, Measurement& m) {
  if (const auto value = exact_value(cell.row, v))
    return std::vector<MeanEstimate>(means(like.first(1)).front().size(), {*value, 0, 0});
  std::vector<MeanEstimate> estimates;
  Series reference;
  // Whatever the method, so that all methods have the same.
  rule.margin = 0;
  const SeriesPlan plan = reference_plan(cell.row, cell.method, v);
  grow_images(plan.batches, std::max(plan.batches, cell.row.most_batches), [&](int batches) {
    reference = render_reference(cell.laboratory, cell.row, cell.method, v, batches);
    estimates = estimate_each(means(reference));
    return compare(estimates, std::vector<MeanEstimate>(estimates.size(), {mean_of(estimates)}), rule)
               .power.noise /
           kReferenceNoise;
  });
  if (reference.width != like.width || reference.height != like.height)
    throw CatalogueError(cell.row.name + ": the reference has another size");
  require_finite(reference, m);
  return estimates;
}

/// Whether the images of the reference are made of the same random numbers as those of the subject.
bool is_paired(const Cell& cell, const Variant& v) {
  const SeriesPlan a = subject_plan(cell.row, cell.method, v),
                   b = reference_plan(cell.row, cell.method, v);
  return !exact_value(cell.row, v) && cell.row.reference.sum.empty() && a.seed == b.seed &&
         a.spp == b.spp && a.independent == b.independent;
}

/// The subject and the reference of a comparison.
struct Sides {
  std::vector<MeanEstimate> subject, reference;
};

/// Images made of the same random numbers differ much less than they vary: what counts is the
/// error of their differences.
Sides paired_sides(const Cell& cell, const Variant& v, const Series& subject, const Means& means,
                   Measurement& m) {
  const Series reference = render_reference(cell.laboratory, cell.row, cell.method, v,
                                            int(subject.pictures.size()));
  require_finite(reference, m);
  const auto b = means(reference);
  auto a = means(subject);
  Sides sides{{}, estimate_each(b)};
  for (size_t n = 0; n < a.size(); ++n)
    for (size_t i = 0; i < a[n].size(); ++i) a[n][i] += sides.reference[i].mean - b[n][i];
  sides.subject = estimate_each(a);
  for (MeanEstimate& e : sides.reference) e = {e.mean, 0, 0};
  return sides;
}

Sides both_sides(const Cell& cell, const Variant& v, const Series& subject, const Means& means,
                 const Rule& rule, Measurement& m) {
  if (is_paired(cell, v)) return paired_sides(cell, v, subject, means, m);
  return {estimate_each(means(subject)), reference_means(cell, v, subject, means, rule, m)};
}

/// The level of a test of one of so many means of each variant, and by how much they may be off.
Rule rule_of(const Cell& cell, const Series& subject, double means, double resolution) {
  return {sidak(cell.level, double(cell.row.variants.size()) * means),
          merges(subject.method) ? cell.margin : 0, resolution, cell.coarser};
}

/// "takes vcm, " if the method under test is one that takes another.
std::string taken(const Cell& cell, const Series& subject) {
  return subject.method == cell.method ? "" : "takes " + subject.method + ", ";
}

/// A series against its reference by a grid of tiles.
Measurement compare_grid(const Cell& cell, const Variant& v, const Series& subject, int grid_x,
                         int grid_y) {
  Measurement m;
  const Means means = [&](const Series& s) { return tile_means(s, grid_x, grid_y); };
  const Rule rule = rule_of(cell, subject, double(grid_x) * grid_y, kTileResolution);
  const Sides sides = both_sides(cell, v, subject, means, rule, m);
  const GridComparison c = compare(sides.subject, sides.reference, rule);
  m.value = c.rms;
  m.power = c.power;
  m.holds &= c.least_p > rule.level && (cell.limit <= 0 || c.mean_z2 < cell.limit);
  m.detail = fmt::format("{}mean {:+.2f} %, z² {:.2f}, p {:.1g}, {} images", taken(cell, subject),
                         100 * (c.ratio - 1), c.mean_z2, c.least_p, subject.pictures.size());
  require_finite(subject, m);
  return m;
}

}  // namespace

Measurement measure_tiles(const Cell& cell) {
  return worst_resolved_variant(cell, [&](const Variant& v, int batches) {
    return compare_grid(cell, v, render_subject(cell, v, batches), cell.row.tiles, cell.row.tiles);
  });
}

Measurement measure_pixels(const Cell& cell) {
  return worst_resolved_variant(cell, [&](const Variant& v, int batches) {
    const Series subject = render_subject(cell, v, batches);
    return compare_grid(cell, v, subject, subject.width, subject.height);
  });
}

Measurement compare_energy(const Cell& cell, const Series& subject, const Variant& v) {
  Measurement m;
  const Means means = [&](const Series& s) {
    std::vector<std::vector<double>> of_each;
    for (const double mean : region_means(s, cell.row.region)) of_each.push_back({mean});
    return of_each;
  };
  const Rule rule = rule_of(cell, subject, 1, kMeanResolution);
  const Sides sides = both_sides(cell, v, subject, means, rule, m);
  const GridComparison c = compare(sides.subject, sides.reference, rule);
  m.value = c.ratio - 1;
  m.error = std::sqrt(c.error2);
  m.power = c.power;
  m.holds &= c.least_p > rule.level;
  m.detail = fmt::format("{}{} images", taken(cell, subject), subject.pictures.size());
  require_finite(subject, m);
  return m;
}

Measurement measure_energy(const Cell& cell) {
  return worst_resolved_variant(cell, [&](const Variant& v, int batches) {
    return compare_energy(cell, render_subject(cell, v, batches), v);
  });
}

Measurement measure_region(const Cell& cell) {
  return worst_resolved_variant(cell, [&](const Variant& v, int batches) {
    const Series series = render_subject(cell, v, batches);
    const auto share = [&](const Series& s) {
      return estimate_mean(region_means(s, cell.row.region)).mean /
             estimate_mean(region_means(s, cell.row.over)).mean;
    };
    const int groups = jackknife_groups(series.pictures.size());
    Measurement m;
    m.value = share(series);
    m.error = jackknife_error(groups, [&](int g) { return share(series.without(g, groups)); });
    m.holds = m.value < cell.limit;
    m.power = limit_power(cell.limit, cell.coarser * cell.limit, m.error, groups - 1);
    m.detail = taken(cell, series) + fmt::format("{} images", series.pictures.size());
    require_finite(series, m);
    return m;
  });
}

Measurement measure_paired(const Cell& cell) {
  return worst_variant(cell, [&](const Variant& v) {
    const Series a = cell.laboratory.render(subject_plan(cell.row, cell.method, v));
    const Series b = render_reference(cell.laboratory, cell.row, cell.method, v);
    Measurement m;
    double squares = 0, sum = 0, difference = 0;
    for (size_t n = 0; n < a.pictures.size(); ++n)
      for (size_t i = 0; i < a.pixels(); ++i) {
        const double x = double(a.pictures[n].grey[i]), y = double(b.pictures[n].grey[i]);
        squares += (x - y) * (x - y), sum += y, difference += x - y;
      }
    const double count = double(a.pictures.size() * a.pixels());
    m.value = std::sqrt(squares / count) / (sum / count);
    m.holds = m.value < cell.limit;
    m.power = {cell.limit, cell.limit, 0};
    m.detail = fmt::format("mean {:+.4f} %", 100 * difference / sum);
    require_finite(a, m);
    return m;
  });
}

namespace {

/// The power of an order of the bias: `first` and `last` are the comparisons at the greatest and
/// the least radius, so many halvings apart. A bias that shrinks too slowly is one that is left
/// over at the least radius; its root mean square is known as well as normal errors of so many
/// tiles allow.
Power order_power(const Cell& cell, const GridComparison& first, const GridComparison& last,
                  double tiles, double halvings) {
  const auto relative_error = [&](const GridComparison& c, double rms) {
    return std::sqrt((2 * c.error4 + 4 * rms * rms * c.error2) / tiles) / (2 * rms * rms);
  };
  const double left = first.rms * std::exp2(-halvings * cell.limit);
  const double error =
      std::hypot(relative_error(first, first.rms), relative_error(last, left)) /
      (halvings * std::log(2.0));
  return limit_power(cell.limit, -0.5 * cell.coarser * cell.limit, error, tiles);
}

}  // namespace

Measurement measure_shrinking(const Cell& cell) {
  return measure_resolved(cell, [&](int batches) {
    Measurement m;
    const int grid = cell.row.tiles;
    const Means means = [&](const Series& s) { return tile_means(s, grid, grid); };
    std::vector<GridComparison> biases;
    for (const Variant& v : cell.row.variants) {
      const Series subject = render_subject(cell, v, batches);
      Rule rule = rule_of(cell, subject, double(grid) * grid, kTileResolution);
      rule.margin = 0;
      const auto b = reference_means(cell, v, subject, means, rule, m);
      biases.push_back(compare(estimate_each(means(subject)), b, rule));
      m.detail += fmt::format("{}{:.2f} %", biases.size() > 1 ? ", " : "bias ",
                              100 * biases.back().rms);
      require_finite(subject, m);
    }
    m.detail += fmt::format(", {} images", batches);
    const double halvings = double(biases.size() - 1);
    // A bias that is lost in the noise has shrunk by as much as can be seen.
    m.value = std::log2(biases.front().rms / std::max(biases.back().rms, 1e-4)) / halvings;
    m.holds &= m.value >= cell.limit;
    m.power = order_power(cell, biases.front(), biases.back(), double(grid) * grid, halvings);
    return m;
  });
}

}  // namespace duet::stability
