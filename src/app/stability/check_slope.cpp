// How fast errors shrink with the number of samples.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/stability/checks.h"
#include "integrators/pass.h"

namespace duet::stability {

namespace {

/// Samples at which the error is looked at: 4, 16, 64, … up to the row's.
constexpr int kFirst = 4, kFactor = 4;
/// Pixels count whose reference is better known than this.
constexpr double kReferenceError = 0.02;

/// The mean of a reference and the squared standard error of its pixels.
struct Truth {
  std::vector<double> mean, error2;
};

Truth truth_of(const Series& series) {
  Truth t;
  std::vector<double> pixel(series.images.size());
  for (size_t i = 0; i < series.pixels(); ++i) {
    for (size_t b = 0; b < pixel.size(); ++b) pixel[b] = double(series.images[b][i]);
    const MeanEstimate e = estimate_mean(pixel);
    t.mean.push_back(e.mean);
    t.error2.push_back(e.error2);
  }
  return t;
}

/// One image of each number of samples, all from one sequence.
std::vector<Series> render_steps(const Cell& cell, const SeriesPlan& plan) {
  std::vector<Series> steps;
  for (int b = 0; b < plan.batches; ++b) {
    Experiment e = cell.laboratory.prepare(plan);
    Film film(e.layout, e.integrator->channels());
    e.integrator->prepare(film);
    PassControl control;
    control.threads = cell.laboratory.threads();
    int done = 0;
    size_t step = 0;
    for (int spp = kFirst; spp <= plan.spp; spp *= kFactor, ++step) {
      if (step == steps.size()) steps.emplace_back();
      const SampleRange range{
          plan.independent ? SampleSequence::independent : SampleSequence::sobol,
          plan.batch_seed(b), 0, uint32_t(done), uint32_t(spp - done)};
      e.integrator->render_pass(e.scene, film, range, control, steps[step].counters);
      done = spp;
      Image image = film.develop();
      e.integrator->finish(image, spp);
      steps[step].add(image);
    }
    cell.laboratory.check_cancelled();
  }
  return steps;
}

struct Fit {
  double slope = 0, error = 0;
};

/// The slope of log(error) over log(samples) by least squares, every batch on its own; `debiased`
/// takes off what the noise of the truth adds to the squared errors.
Fit fit_slope(const std::vector<Series>& steps, const Truth& truth, const Truth& selection,
              bool debiased) {
  double scale2 = 0;
  for (const double m : selection.mean) scale2 += m * m;
  scale2 /= double(selection.mean.size());
  const size_t batches = steps.front().images.size();
  // The mean square error of each step and batch.
  std::vector<std::vector<double>> errors(steps.size(), std::vector<double>(batches));
  for (size_t s = 0; s < steps.size(); ++s)
    for (size_t b = 0; b < batches; ++b)
      for (size_t i = 0; i < truth.mean.size(); ++i) {
        const double m2 = selection.mean[i] * selection.mean[i] + 0.01 * scale2;
        if (selection.error2[i] > kReferenceError * kReferenceError * m2) continue;
        const double d = double(steps[s].images[b][i]) - truth.mean[i];
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
  double squares = 0;
  for (size_t b = 0; b < batches; ++b) squares += std::pow(slope(b) - fit.slope, 2);
  fit.error = std::sqrt(squares * double(batches - 1) / double(batches));
  return fit;
}

}  // namespace

Measurement measure_slope(const Cell& cell) {
  const Variant& v = cell.row.variants.front();
  const Truth truth = truth_of(render_reference(cell.laboratory, cell.row, cell.method, v));
  const std::vector<Series> steps = render_steps(cell, subject_plan(cell.row, cell.method, v));
  const Fit fit = fit_slope(steps, truth, truth, true);
  Measurement m;
  m.value = fit.slope, m.error = fit.error;
  m.holds = m.value <= cell.limit;
  require_finite(steps.back(), m);
  return m;
}

Measurement measure_slope_debiasing(const Cell& cell) {
  const Variant& v = cell.row.variants.front();
  const Series reference = render_reference(cell.laboratory, cell.row, cell.method, v);
  const Truth truth = truth_of(reference);
  // A reference of few of the images, as someone in a hurry would make it.
  Series few = reference;
  few.images.resize(std::max<size_t>(2, few.images.size() / 16));
  const Truth noisy = truth_of(few);
  const std::vector<Series> steps = render_steps(cell, subject_plan(cell.row, cell.method, v));
  const double good = fit_slope(steps, truth, truth, true).slope;
  const double debiased = fit_slope(steps, noisy, truth, true).slope;
  const double plain = fit_slope(steps, noisy, truth, false).slope;
  Measurement m;
  m.value = std::abs(debiased - good);
  m.holds = m.value < cell.limit;
  m.detail = fmt::format(
      "{:.3f} with a good reference, {:.3f} with a noisy one, {:.3f} if its "
      "noise is not taken off",
      good, debiased, plain);
  require_finite(steps.back(), m);
  return m;
}

}  // namespace duet::stability
