// How noise behaves: fireflies, spikes, variances and what they cost.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "evaluate/stability/checks.h"

namespace duet::stability {

namespace {

/// Shares of the pixel values that count as their tail.
constexpr double kBrightest = 0.001, kTail = 0.003;

/// Hill's estimate of the exponent of the tail of the values: below 2 the variance is infinite.
/// Source: Hill, "A simple general approach to inference about the tail of a distribution", Annals
/// of Statistics 3, 1975. `values` are sorted from the greatest down.
double hill_index(const std::vector<float>& values) {
  const size_t k = size_t(kTail * double(values.size()));
  if (k < 2 || !(values[k] > 0)) return INFINITY;
  double sum = 0;
  for (size_t i = 0; i < k; ++i) sum += std::log(double(values[i]) / double(values[k]));
  return sum > 0 ? double(k) / sum : INFINITY;
}

/// The mean of what pixels say about noise, without the worst thousandth of them.
double trimmed_mean(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  values.resize(values.size() - size_t(std::ceil(kBrightest * double(values.size()))));
  return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

/// What squared errors of pixels are divided by: the squared mean, with a hundredth of the mean
/// square of all pixels added.
std::vector<double> squared_scales(std::vector<double> mean) {
  double sum = 0;
  for (double& m : mean) sum += m *= m;
  for (double& m : mean) m += 0.01 * sum / double(mean.size());
  return mean;
}

/// The statistics of each pixel over the images.
std::vector<MeanEstimate> pixel_estimates(const Series& series) {
  std::vector<MeanEstimate> estimates;
  std::vector<double> pixel(series.pictures.size());
  for (size_t i = 0; i < series.pixels(); ++i) {
    for (size_t b = 0; b < pixel.size(); ++b) pixel[b] = double(series.pictures[b].grey[i]);
    estimates.push_back(estimate_mean(pixel));
  }
  return estimates;
}

/// The variance of an image, relative to the square of `mean`.
double relative_variance(const Series& series, const std::vector<double>& mean) {
  std::vector<double> values = squared_scales(mean);
  const std::vector<MeanEstimate> pixels = pixel_estimates(series);
  for (size_t i = 0; i < values.size(); ++i)
    values[i] = pixels[i].error2 * pixels[i].count / values[i];
  return trimmed_mean(std::move(values));
}

/// The mean square error of an image, relative to the square of the reference; the noise of the
/// reference is taken off. What a method loses counts, too: a black image has no variance.
double relative_error(const Series& series, const Series& reference) {
  const std::vector<MeanEstimate> truth = pixel_estimates(reference),
                                  pixels = pixel_estimates(series);
  std::vector<double> values = squared_scales(mean_image(reference));
  for (size_t i = 0; i < values.size(); ++i) {
    const double d = pixels[i].mean - truth[i].mean, variance = pixels[i].error2 * pixels[i].count;
    values[i] = (variance + d * d - pixels[i].error2 - truth[i].error2) / values[i];
  }
  return trimmed_mean(std::move(values));
}

double relative_variance(const Series& series) {
  return relative_variance(series, mean_image(series));
}

/// The power of a statistic of one series, by the jackknife. `slack` as in limit_power().
Power series_power(const Cell& cell, const Series& series, double slack,
                   const std::function<double(const Series&)>& statistic, double& error) {
  const int groups = jackknife_groups(series.pictures.size());
  error = jackknife_error(groups, [&](int g) { return statistic(series.without(g, groups)); });
  return limit_power(cell.limit, cell.coarser * slack, error, groups - 1);
}

/// The share of the light that is in the brightest pixels of all images together.
double brightest_share(const Series& series, double& hill) {
  std::vector<float> values;
  for (const Picture& picture : series.pictures)
    values.insert(values.end(), picture.grey.begin(), picture.grey.end());
  std::sort(values.begin(), values.end(), std::greater<>());
  hill = hill_index(values);
  const double total = std::accumulate(values.begin(), values.end(), 0.0);
  const size_t brightest = size_t(std::ceil(kBrightest * double(values.size())));
  return std::accumulate(values.begin(), values.begin() + ptrdiff_t(brightest), 0.0) / total;
}

}  // namespace

Measurement measure_fireflies(const Cell& cell) {
  return worst_resolved_variant(cell, [&](const Variant& v, int batches) {
    SeriesPlan plan = subject_plan(cell.row, cell.method, v);
    plan.spp = 1, plan.batches = batches;
    const Series s = cell.laboratory.render(plan);
    Measurement m;
    double hill = 0, ignored = 0;
    m.value = brightest_share(s, hill);
    m.holds = m.value < cell.limit;
    m.power = series_power(
        cell, s, cell.limit, [&](const Series& part) { return brightest_share(part, ignored); },
        m.error);
    m.detail = fmt::format("Hill index {:.2f}", hill);
    require_finite(s, m);
    return m;
  });
}

namespace {

/// The brightest pixel of an image over the median of its neighbours.
double brightest_spike(const std::vector<float>& image, int width, int height) {
  const double mean = std::accumulate(image.begin(), image.end(), 0.0) / double(image.size());
  const auto at = [&](int x, int y) {
    return double(image[size_t(y) * size_t(width) + size_t(x)]);
  };
  double spike = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      std::vector<double> near;
      for (int j = std::max(0, y - 2); j <= std::min(height - 1, y + 2); ++j)
        for (int i = std::max(0, x - 2); i <= std::min(width - 1, x + 2); ++i)
          if (i != x || j != y) near.push_back(at(i, j));
      std::nth_element(near.begin(), near.begin() + ptrdiff_t(near.size() / 2), near.end());
      // Where all around is nearly black there is nothing to be brighter than.
      spike = std::max(spike, at(x, y) / std::max(near[near.size() / 2], 1e-3 * mean));
    }
  return spike;
}

}  // namespace

Measurement measure_spike(const Cell& cell) {
  return worst_variant(cell, [&](const Variant& v) {
    const Series s = cell.laboratory.render(subject_plan(cell.row, cell.method, v));
    Measurement m;
    for (const Picture& picture : s.pictures)
      m.value = std::max(m.value, brightest_spike(picture.grey, s.width, s.height));
    m.holds = m.value < cell.limit;
    m.power = {cell.limit, cell.limit, 0};
    // What happens to one of n pixels is missed by N of them with a probability of exp(-N / n).
    const double pixels = double(s.pictures.size() * s.pixels());
    m.detail = fmt::format("{:.0f} pixels: seen if one of {:.0f} is a spike", pixels,
                           pixels / -std::log(1 - kPowerShare));
    require_finite(s, m);
    return m;
  });
}

Measurement measure_noise(const Cell& cell) {
  return worst_resolved_variant(cell, [&](const Variant& v, int batches) {
    const Series s = render_subject(cell, v, batches);
    const auto noise = [](const Series& part) { return std::sqrt(relative_variance(part)); };
    Measurement m;
    m.value = noise(s);
    m.holds = m.value < cell.limit;
    m.power = series_power(cell, s, cell.limit, noise, m.error);
    require_finite(s, m);
    return m;
  });
}

Measurement measure_jump(const Cell& cell) {
  return measure_resolved(cell, [&](int batches) {
    Measurement m;
    Series before;
    std::string before_label;
    for (const Variant& v : cell.row.variants) {
      Series s = render_subject(cell, v, batches);
      require_finite(s, m);
      if (!before_label.empty()) {
        const auto ratio = [](const Series& a, const Series& b) {
          const double r = relative_variance(a) / relative_variance(b);
          return std::max(r, 1 / r);
        };
        const int groups = jackknife_groups(s.pictures.size());
        const double value = ratio(s, before),
                     error = jackknife_error(groups, [&](int g) {
                       return ratio(s.without(g, groups), before.without(g, groups));
                     });
        m.power = weaker(m.power, limit_power(cell.limit, cell.coarser * cell.limit,
                                              error * cell.limit / value, groups - 1));
        if (value > m.value) {
          m.value = value, m.error = error;
          m.detail = before_label + " to " + v.label;
        }
      }
      before = std::move(s), before_label = v.label;
    }
    m.holds &= m.value < cell.limit;
    return m;
  });
}

Measurement measure_efficiency(const Cell& cell) {
  return worst_resolved_variant(cell, [&](const Variant& v, int batches) {
    const Series a = render_subject(cell, v, batches);
    const Series b = render_reference(cell.laboratory, cell.row, cell.method, v,
                                      cell.row.reference.method == "self" ? batches : 0);
    // Of one image each: the series may differ in their number.
    const double rays =
        a.rays() / double(a.pictures.size()) / (b.rays() / double(b.pictures.size()));
    const auto error_ratio = [](const Series& x, const Series& y) {
      return relative_error(x, y) / relative_variance(y);
    };
    const double squares = error_ratio(a, b);
    const int groups = jackknife_groups(std::min(a.pictures.size(), b.pictures.size()));
    Measurement m;
    m.value = 1 / (squares * rays);
    m.error = jackknife_error(groups, [&](int g) {
      return 1 / (error_ratio(a.without(g, groups), b.without(g, groups)) * rays);
    });
    m.holds = m.value >= cell.limit;
    // The error is a share of the value; at the limit it is that share of the limit.
    m.power = limit_power(cell.limit, -0.5 * std::min(cell.coarser, 1.5) * cell.limit,
                          m.error * cell.limit / std::max(m.value, cell.limit), groups - 1);
    m.detail = fmt::format("squared error x {:.3g}, rays x {:.3g}", squares, rays);
    require_finite(a, m);
    return m;
  });
}

Measurement measure_variance(const Cell& cell) {
  constexpr int kLonger = 16;
  return worst_resolved_variant(cell, [&](const Variant& v, int batches) {
    SeriesPlan plan = subject_plan(cell.row, cell.method, v);
    plan.batches = batches;
    const Series one = cell.laboratory.render(plan);
    plan.spp *= kLonger;
    const Series many = cell.laboratory.render(plan);
    const std::vector<double> mean = mean_image(many);
    const auto ratio = [&](const Series& longer, const Series& shorter) {
      return kLonger * relative_variance(longer, mean) / relative_variance(shorter, mean);
    };
    const int groups = jackknife_groups(one.pictures.size());
    Measurement m;
    m.value = ratio(many, one);
    m.error = jackknife_error(
        groups, [&](int g) { return ratio(many.without(g, groups), one.without(g, groups)); });
    m.holds = m.value < cell.limit;
    m.power = limit_power(cell.limit, cell.coarser * (cell.limit - 1), m.error, groups - 1);
    // Noise that all pixels share: variance of the mean of the image, against that of independent
    // pixels.
    double independent = 0;
    for (const MeanEstimate& e : pixel_estimates(one)) independent += e.error2;
    independent /= double(one.pixels()) * double(one.pixels());
    const double shared = estimate_mean(region_means(one, {0, 0, 1, 1})).error2 / independent;
    m.detail = fmt::format(
        "variance of the image's mean is {:.1f} times that of independent pixels", shared);
    require_finite(one, m);
    require_finite(many, m);
    return m;
  });
}

}  // namespace duet::stability
