// Whether means are right: by tiles, by pixels, over the whole image or a part of it.
#include <fmt/format.h>

#include <cmath>

#include "evaluate/stability/compare_means.h"

namespace duet::stability {

namespace {

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
  const double error = std::hypot(relative_error(first, first.rms), relative_error(last, left)) /
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
      const Sides sides = both_sides(cell, v, subject, means, rule, m);
      biases.push_back(compare(sides.subject, sides.reference, rule));
      m.detail +=
          fmt::format("{}{:.2f} %", biases.size() > 1 ? ", " : "bias ", 100 * biases.back().rms);
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
