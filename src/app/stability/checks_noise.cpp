// How noise behaves: fireflies, spikes, variances and what they cost.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "app/stability/checks.h"

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
  std::vector<double> pixel(series.images.size());
  for (size_t i = 0; i < series.pixels(); ++i) {
    for (size_t b = 0; b < pixel.size(); ++b) pixel[b] = double(series.images[b][i]);
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

}  // namespace

Measurement measure_fireflies(const Cell& cell) {
  return worst_variant(cell, [&](const Variant& v) {
    SeriesPlan plan = subject_plan(cell.row, cell.method, v);
    plan.spp = 1;
    const Series& s = cell.laboratory.render(plan);
    std::vector<float> values;
    for (const std::vector<float>& image : s.images)
      values.insert(values.end(), image.begin(), image.end());
    std::sort(values.begin(), values.end(), std::greater<>());
    const double total = std::accumulate(values.begin(), values.end(), 0.0);
    const size_t brightest = size_t(std::ceil(kBrightest * double(values.size())));
    Measurement m;
    m.value = std::accumulate(values.begin(), values.begin() + ptrdiff_t(brightest), 0.0) / total;
    m.holds = m.value < cell.limit;
    m.detail = fmt::format("Hill index {:.2f}", hill_index(values));
    require_finite(s, m);
    return m;
  });
}

Measurement measure_spike(const Cell& cell) {
  return worst_variant(cell, [&](const Variant& v) {
    const Series& s = cell.laboratory.render(subject_plan(cell.row, cell.method, v));
    const std::vector<double> image = mean_image(s);
    const double mean = std::accumulate(image.begin(), image.end(), 0.0) / double(image.size());
    Measurement m;
    for (int y = 0; y < s.height; ++y)
      for (int x = 0; x < s.width; ++x) {
        std::vector<double> near;
        for (int j = std::max(0, y - 2); j <= std::min(s.height - 1, y + 2); ++j)
          for (int i = std::max(0, x - 2); i <= std::min(s.width - 1, x + 2); ++i)
            if (i != x || j != y) near.push_back(image[size_t(j) * size_t(s.width) + size_t(i)]);
        std::nth_element(near.begin(), near.begin() + ptrdiff_t(near.size() / 2), near.end());
        // Where all around is nearly black there is nothing to be brighter than.
        const double median = std::max(near[near.size() / 2], 1e-3 * mean);
        m.value = std::max(m.value, image[size_t(y) * size_t(s.width) + size_t(x)] / median);
      }
    m.holds = m.value < cell.limit;
    require_finite(s, m);
    return m;
  });
}

Measurement measure_noise(const Cell& cell) {
  return worst_variant(cell, [&](const Variant& v) {
    const Series& s = cell.laboratory.render(subject_plan(cell.row, cell.method, v));
    Measurement m;
    m.value = std::sqrt(relative_variance(s));
    m.holds = m.value < cell.limit;
    require_finite(s, m);
    return m;
  });
}

Measurement measure_jump(const Cell& cell) {
  Measurement m;
  double before = 0;
  std::string before_label;
  for (const Variant& v : cell.row.variants) {
    const Series& s = cell.laboratory.render(subject_plan(cell.row, cell.method, v));
    const double variance = relative_variance(s);
    const double ratio = before > 0 ? std::max(variance / before, before / variance) : 1;
    if (ratio > m.value) {
      m.value = ratio;
      m.detail = before > 0 ? before_label + " to " + v.label : "";
    }
    before = variance, before_label = v.label;
    require_finite(s, m);
  }
  m.holds &= m.value < cell.limit;
  return m;
}

Measurement measure_efficiency(const Cell& cell) {
  return worst_variant(cell, [&](const Variant& v) {
    const Series& a = cell.laboratory.render(subject_plan(cell.row, cell.method, v));
    const Series b = render_reference(cell.laboratory, cell.row, cell.method, v);
    const double va = relative_error(a, b), vb = relative_variance(b);
    // Of one image each: the series may differ in their number.
    const double ra = a.rays() / double(a.images.size()), rb = b.rays() / double(b.images.size());
    Measurement m;
    m.value = vb * rb / (va * ra);
    // Deviations of variances from few images are about as large as this.
    m.error = m.value * std::sqrt(2.0 / double(a.images.size() * a.pixels()) +
                                  2.0 / double(b.images.size() * b.pixels()));
    m.holds = m.value >= cell.limit;
    m.detail = fmt::format("squared error x {:.3g}, rays x {:.3g}", va / vb, ra / rb);
    require_finite(a, m);
    return m;
  });
}

Measurement measure_variance(const Cell& cell) {
  constexpr int kLonger = 16;
  return worst_variant(cell, [&](const Variant& v) {
    SeriesPlan plan = subject_plan(cell.row, cell.method, v);
    const Series& one = cell.laboratory.render(plan);
    plan.spp *= kLonger;
    const Series& many = cell.laboratory.render(plan);
    const std::vector<double> mean = mean_image(many);
    Measurement m;
    m.value = kLonger * relative_variance(many, mean) / relative_variance(one, mean);
    m.holds = m.value < cell.limit;
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
