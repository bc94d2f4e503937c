#include "app/chart_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace duet {

namespace {

/// A field of a CSV file (RFC 4180).
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + "\"";
}

/// The root of a squared error that may be below zero because of what was subtracted.
double root(double squared) {
  return std::copysign(std::sqrt(std::abs(squared)), squared);
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

std::optional<Efficiency> efficiency(const ChartLine& line) {
  if (line.points.empty()) return std::nullopt;
  const ChartPoint& p = line.points.back();
  const double cost = p.trimmed * p.cpu_seconds;
  if (!(cost > 0)) return std::nullopt;
  Efficiency e{1 / cost, {}};
  if (!line.by_time.value_95.empty()) {
    const Interval& i = line.by_time.value_95.back();
    e.interval_95 = {1 / (i.high * p.cpu_seconds),
                     i.low > 0 ? 1 / (i.low * p.cpu_seconds) : INFINITY};
  }
  return e;
}

double best_efficiency(const ChartScene& scene) {
  double best = 0;
  for (const ChartLine& line : scene.lines)
    if (const auto e = efficiency(line)) best = std::max(best, e->value);
  return best;
}

std::optional<TimeToError> time_to_error(const ChartLine& line, double relative_rmse) {
  const double target = relative_rmse * relative_rmse;
  const std::vector<ChartPoint>& p = line.points;
  for (size_t i = 0; i < p.size(); ++i) {
    if (p[i].trimmed > target) continue;
    // To what is below zero there is no line on logarithmic axes.
    if (i == 0 || !(p[i].trimmed > 0)) return TimeToError{p[i].cpu_seconds, TimeToError::at_most};
    const double t =
        std::log(p[i - 1].trimmed / target) / std::log(p[i - 1].trimmed / p[i].trimmed);
    return TimeToError{p[i - 1].cpu_seconds * std::pow(p[i].cpu_seconds / p[i - 1].cpu_seconds, t)};
  }
  if (p.empty() || !line.by_time.slope || !(line.by_time.slope->slope < 0)) return std::nullopt;
  const double factor = std::sqrt(p.back().trimmed / target);
  return TimeToError{p.back().cpu_seconds * std::pow(factor, -1 / line.by_time.slope->slope),
                     TimeToError::extrapolated};
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
          fmt::format("{},{:.4f},{:.4f},{},{:.6g},{:.6g},{:.6g},{:.6g}\n", field(line.name),
                      p.seconds, p.cpu_seconds, p.spp, root(p.mse), p.relmse, p.trimmed, p.firefly);
  return csv;
}

std::string summary_csv(const std::vector<ChartScene>& scenes) {
  std::string csv = "scene,integrator,spp,cpu_seconds,trimmed,firefly,slope,efficiency,ratio\n";
  for (const ChartScene& scene : scenes)
    for (const ChartLine& line : scene.lines) {
      if (line.points.empty()) continue;
      const ChartPoint& p = line.points.back();
      const auto e = efficiency(line);
      csv += fmt::format("{},{},{},{:.4f},{:.6g},{:.6g},{},{},{}\n", field(scene.name),
                         field(line.name), p.spp, p.cpu_seconds, p.trimmed, p.firefly,
                         line.by_time.slope ? fmt::format("{:.4f}", line.by_time.slope->slope) : "",
                         e ? fmt::format("{:.6g}", e->value) : "",
                         e ? fmt::format("{:.4f}", e->value / best_efficiency(scene)) : "");
    }
  return csv;
}

}  // namespace duet
