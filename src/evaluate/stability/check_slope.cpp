// How fast errors shrink with the number of samples.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "evaluate/stability/checks.h"
#include "integrators/pass.h"
#include "math/statistics.h"

namespace duet::stability {

namespace {

/// Samples at which the error is looked at: 4, 16, 64, … up to the row's.
constexpr int kFirst = 4, kFactor = 4;
/// Pixels count whose reference is better known than this.
constexpr double kReferenceError = 0.02;
/// Of methods without bias.
constexpr double kIdealSlope = -0.5;

/// The mean of a reference and the squared standard error of its pixels.
struct Truth {
  std::vector<double> mean, error2;
};

Truth truth_of(const Series& series) {
  Truth t;
  std::vector<double> pixel(series.pictures.size());
  for (size_t i = 0; i < series.pixels(); ++i) {
    for (size_t b = 0; b < pixel.size(); ++b) pixel[b] = double(series.pictures[b].grey[i]);
    const MeanEstimate e = estimate_mean(pixel);
    t.mean.push_back(e.mean);
    t.error2.push_back(e.error2);
  }
  return t;
}

/// The images of one batch after each number of samples, all from one sequence, one after another.
Image image_of_steps(const SeriesPlan& plan, int batch, Experiment& e,
                     std::vector<Image>& after_each, RenderCounters& counters) {
  Film film(e.layout, e.integrator->channels());
  e.integrator->prepare(film);
  int done = 0;
  for (int spp = kFirst; spp <= plan.spp; spp *= kFactor) {
    const SampleRange range{plan.independent ? SampleSequence::independent : SampleSequence::sobol,
                            plan.batch_seed(batch), 0, uint32_t(done), uint32_t(spp - done)};
    e.integrator->render_pass(e.scene, film, range, {}, counters);
    done = spp;
    after_each.push_back(film.develop());
  }
  return after_each.back();
}

/// Series of images of each number of samples, all of a batch from one sequence.
struct Steps {
  std::vector<Series> series;

  void extend(const Cell& cell, const Variant& v, int batches) {
    SeriesPlan plan = subject_plan(cell.row, cell.method, v);
    plan.batches = batches;
    const size_t there = whole_.pictures.size();
    std::vector<std::vector<Image>> after_each(size_t(plan.batches));
    cell.laboratory.extend(whole_, plan, [&](Experiment& e, int batch, RenderCounters& counters) {
      cell.laboratory.check_cancelled();
      return image_of_steps(plan, batch, e, after_each[size_t(batch)], counters);
    });
    series.resize(after_each.back().size());
    for (size_t b = there; b < after_each.size(); ++b)
      for (size_t s = 0; s < series.size(); ++s)
        series[s].add(after_each[b][s], whole_.pictures[b].counters);
  }

 private:
  Series whole_;
};

struct Fit {
  double slope = 0, error = 0;
  std::vector<double> without;  ///< the slopes without each of the batches in turn
};

/// The slope of log(error) over log(samples) by least squares, every batch on its own; `debiased`
/// takes off what the noise of the truth adds to the squared errors.
Fit fit_slope(const std::vector<Series>& steps, const Truth& truth, const Truth& selection,
              bool debiased) {
  double scale2 = 0;
  for (const double m : selection.mean) scale2 += m * m;
  scale2 /= double(selection.mean.size());
  const size_t batches = steps.front().pictures.size();
  // The mean square error of each step and batch.
  std::vector<std::vector<double>> errors(steps.size(), std::vector<double>(batches));
  for (size_t s = 0; s < steps.size(); ++s)
    for (size_t b = 0; b < batches; ++b)
      for (size_t i = 0; i < truth.mean.size(); ++i) {
        const double m2 = selection.mean[i] * selection.mean[i] + 0.01 * scale2;
        if (selection.error2[i] > kReferenceError * kReferenceError * m2) continue;
        const double d = double(steps[s].pictures[b].grey[i]) - truth.mean[i];
        errors[s][b] += (d * d - (debiased ? truth.error2[i] : 0)) / m2;
      }
  // Jackknife: the slope without each of the batches in turn tells how certain it is.
  const auto slope = [&](size_t without) {
    double sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (size_t s = 0; s < steps.size(); ++s) {
      double sum = 0;
      for (size_t b = 0; b < batches; ++b) sum += b == without ? 0 : errors[s][b];
      const double x = double(s) * std::log(double(kFactor)),
                   y = 0.5 * std::log(std::max(sum, 1e-30));
      sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    const double n = double(steps.size());
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
  };
  Fit fit;
  fit.slope = slope(batches);
  for (size_t b = 0; b < batches; ++b) fit.without.push_back(slope(b));
  fit.error = jackknife_error(int(batches), [&](int b) { return fit.without[size_t(b)]; });
  return fit;
}

}  // namespace

Measurement measure_slope(const Cell& cell) {
  const Variant& v = cell.row.variants.front();
  const Truth truth = truth_of(render_reference(cell.laboratory, cell.row, cell.method, v));
  Steps steps;
  return measure_resolved(cell, [&](int batches) {
    steps.extend(cell, v, batches);
    const Fit fit = fit_slope(steps.series, truth, truth, true);
    Measurement m;
    m.value = fit.slope, m.error = fit.error;
    m.holds = m.value <= cell.limit;
    m.power =
        limit_power(cell.limit, cell.coarser * (cell.limit - kIdealSlope), fit.error, batches - 1);
    require_finite(steps.series.back(), m);
    return m;
  });
}

Measurement measure_slope_debiasing(const Cell& cell) {
  const Variant& v = cell.row.variants.front();
  const Series reference = render_reference(cell.laboratory, cell.row, cell.method, v);
  const Truth truth = truth_of(reference);
  // A reference of few of the images, as someone in a hurry would make it.
  const Series few = reference.first(std::max<size_t>(3, reference.pictures.size() / 16));
  const Truth noisy = truth_of(few);
  Steps steps;
  return measure_resolved(cell, [&](int batches) {
    steps.extend(cell, v, batches);
    const Fit good = fit_slope(steps.series, truth, truth, true);
    const Fit debiased = fit_slope(steps.series, noisy, truth, true);
    const Fit plain = fit_slope(steps.series, noisy, truth, false);
    // The images and the noisy reference both make the difference uncertain.
    const int few_images = int(few.pictures.size());
    const double of_images = jackknife_error(
        batches, [&](int b) { return debiased.without[size_t(b)] - good.without[size_t(b)]; });
    const double of_reference = jackknife_error(few_images, [&](int g) {
      const Truth fewer = truth_of(few.without(g, few_images));
      return fit_slope(steps.series, fewer, truth, true).slope;
    });
    Measurement m;
    m.value = std::abs(debiased.slope - good.slope);
    m.error = std::hypot(of_images, of_reference);
    m.holds = m.value < cell.limit;
    m.power = limit_power(cell.limit, cell.coarser * cell.limit, m.error,
                          std::min(batches, few_images) - 1);
    m.detail = fmt::format(
        "{:.3f} with a good reference, {:.3f} with a noisy one, {:.3f} if its "
        "noise is not taken off",
        good.slope, debiased.slope, plain.slope);
    require_finite(steps.series.back(), m);
    return m;
  });
}

}  // namespace duet::stability
