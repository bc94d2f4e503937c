#include "evaluate/chart/data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/percent.h"
#include "evaluate/report/csv_field.h"

namespace duet {

namespace {

/// The root of a squared error that may be below zero because of what was subtracted.
double root(double squared) {
  return std::copysign(std::sqrt(std::abs(squared)), squared);
}

/// The efficiency at the last point; infinite if the error that is left is not above zero.
std::optional<Estimate> efficiency_or_more(const ChartLine& line) {
  if (line.points.empty()) return std::nullopt;
  const ChartPoint& p = line.points.back();
  const auto inverse = [&](double error) {
    return error > 0 ? 1 / (error * p.cpu_seconds) : INFINITY;
  };
  const Interval& error = line.by_time.value_95.back();
  return Estimate{inverse(p.trimmed), {inverse(error.high), inverse(error.low)}};
}

/// When errors, given for each point, reach the target. `slope` is that of their roots beyond the
/// last point.
std::optional<TimeToError> crossing(const std::vector<ChartPoint>& points,
                                    const std::vector<double>& errors, double target,
                                    double slope) {
  for (size_t i = 0; i < points.size(); ++i) {
    if (errors[i] > target) continue;
    // To what is below zero there is no line on logarithmic axes.
    if (i == 0 || !(errors[i] > 0))
      return TimeToError{points[i].cpu_seconds, TimeToError::at_most, {}};
    const double t = std::log(errors[i - 1] / target) / std::log(errors[i - 1] / errors[i]);
    const double before = points[i - 1].cpu_seconds;
    return TimeToError{
        before * std::pow(points[i].cpu_seconds / before, t), TimeToError::interpolated, {}};
  }
  if (points.empty() || !(slope < 0)) return std::nullopt;
  return TimeToError{
      points.back().cpu_seconds * std::pow(std::sqrt(errors.back() / target), -1 / slope),
      TimeToError::extrapolated,
      {}};
}

}  // namespace

void fit(ChartLine& line) {
  std::vector<CurvePoint> by_time, by_spp;
  for (const ChartPoint& p : line.points) {
    by_time.push_back({p.cpu_seconds, p.tile_sums, p.tile_pixels});
    by_spp.push_back({double(p.spp), p.tile_sums, p.tile_pixels});
  }
  line.by_time = fit_curve(by_time);
  line.by_spp = fit_curve(by_spp);
}

std::optional<Estimate> efficiency(const ChartLine& line) {
  const auto e = efficiency_or_more(line);
  return e && std::isfinite(e->value) ? e : std::nullopt;
}

double best_efficiency(const ChartScene& scene) {
  double best = 0;
  for (const ChartLine& line : scene.lines)
    if (const auto e = efficiency(line)) best = std::max(best, e->value);
  return best;
}

std::vector<size_t> most_efficient(const ChartScene& scene) {
  std::vector<std::optional<Estimate>> estimates;
  for (const ChartLine& line : scene.lines) estimates.push_back(efficiency_or_more(line));
  return contenders(estimates);
}

std::optional<TimeToError> time_to_error(const ChartLine& line, double root_trimmed) {
  const double target = root_trimmed * root_trimmed;
  const std::vector<Interval>& bounds = line.by_time.value_95;
  const std::optional<SlopeFit>& slope = line.by_time.slope;
  const auto reach = [&](auto error_of, double slope_of) {
    std::vector<double> errors;
    for (size_t i = 0; i < line.points.size(); ++i) errors.push_back(error_of(i));
    return crossing(line.points, errors, target, slope_of);
  };
  auto t = reach([&](size_t i) { return line.points[i].trimmed; }, slope ? slope->slope : 0);
  if (!t) return t;
  const auto early =
      reach([&](size_t i) { return bounds[i].low; }, slope ? slope->slope_95.low : 0);
  const auto late =
      reach([&](size_t i) { return bounds[i].high; }, slope ? slope->slope_95.high : 0);
  t->interval_95 = {early && early->kind != TimeToError::at_most ? early->cpu_seconds : 0,
                    late ? late->cpu_seconds : INFINITY};
  return t;
}

std::vector<size_t> fastest(const ChartScene& scene, double root_trimmed) {
  std::vector<std::optional<Estimate>> estimates;
  for (const ChartLine& line : scene.lines) {
    const auto t = time_to_error(line, root_trimmed);
    if (t)
      estimates.push_back(Estimate{t->cpu_seconds, t->interval_95});
    else if (!line.points.empty())  // some time after its last point
      estimates.push_back(Estimate{INFINITY, {line.points.back().cpu_seconds, INFINITY}});
    else
      estimates.push_back(std::nullopt);
  }
  return contenders(estimates, false);
}

std::vector<double> round_errors(const ChartScene& scene) {
  double least = INFINITY;
  for (const ChartLine& line : scene.lines)
    for (const ChartPoint& p : line.points)
      if (p.trimmed > 0) least = std::min(least, std::sqrt(p.trimmed));
  if (!std::isfinite(least)) return {};
  // 1, 2, 5, 10, 20 … by their number.
  const auto round_number = [](int k) {
    const int power = int(std::floor(k / 3.0));
    return (k - 3 * power == 2 ? 5.0 : k - 3 * power == 1 ? 2.0 : 1.0) * std::pow(10, power);
  };
  int k = -30;
  while (round_number(k) < least) ++k;
  return {round_number(k + 2), round_number(k + 1), round_number(k)};
}

std::string chart_csv(const ChartScene& scene) {
  std::string csv = "integrator,seconds,cpu_seconds,spp,rmse,relmse,trimmed,firefly\n";
  for (const ChartLine& line : scene.lines)
    for (const ChartPoint& p : line.points)
      csv +=
          fmt::format("{},{:.4f},{:.4f},{},{:.6g},{:.6g},{:.6g},{:.6g}\n", csv_field(line.name),
                      p.seconds, p.cpu_seconds, p.spp, root(p.mse), p.relmse, p.trimmed, p.firefly);
  return csv;
}

std::string summary_csv(const std::vector<ChartScene>& scenes) {
  std::string csv =
      "scene,integrator,spp,cpu_seconds,trimmed,firefly,slope,efficiency,ratio,reference\n";
  for (const ChartScene& scene : scenes)
    for (const ChartLine& line : scene.lines) {
      if (line.points.empty()) continue;
      const ChartPoint& p = line.points.back();
      const auto e = efficiency(line);
      csv += fmt::format("{},{},{},{:.4f},{:.6g},{:.6g},{},{},{},{}\n", csv_field(scene.name),
                         csv_field(line.name), p.spp, p.cpu_seconds, p.trimmed, p.firefly,
                         line.by_time.slope ? fmt::format("{:.4f}", line.by_time.slope->slope) : "",
                         e ? fmt::format("{:.6g}", e->value) : "",
                         e ? fmt::format("{:.4f}", e->value / best_efficiency(scene)) : "",
                         csv_field(scene.reference_source));
    }
  return csv;
}

std::string line_summary(const ChartScene& scene, const ChartLine& line) {
  if (line.points.empty()) return fmt::format("{}: {}: no image", scene.name, line.name);
  const ChartPoint& p = line.points.back();
  const auto e = efficiency(line);
  const std::string slope =
      line.by_time.slope ? fmt::format(", slope {:.2f}", line.by_time.slope->slope) : "";
  return fmt::format(
      "{}: {}: {} spp in {:.3g} CPU s, {}", scene.name, line.name, p.spp, p.cpu_seconds,
      e ? fmt::format("root of the trimmed relMSE {}, {:.2f} of the best efficiency{}",
                      percent(std::sqrt(p.trimmed)), e->value / best_efficiency(scene), slope)
        : "error below the reference's noise");
}

}  // namespace duet
