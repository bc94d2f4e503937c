#include "math/slope.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace duet {

namespace {

constexpr int kResamples = 400;
/// The first and last of the sorted resamples that belong to the middle 95 %.
constexpr size_t kFirst = kResamples / 40, kLast = kResamples - 1 - kFirst;

Interval interval_95(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {values[kFirst], values[kLast]};
}

/// values[resample][point]
std::vector<std::vector<double>> resample(const std::vector<CurvePoint>& points) {
  const size_t parts = points[0].sums.size();
  std::mt19937_64 random(1);
  std::vector<std::vector<double>> values(kResamples);
  std::vector<size_t> chosen(parts);
  for (std::vector<double>& v : values) {
    for (size_t& part : chosen) part = random() % parts;
    for (const CurvePoint& p : points) {
      double sum = 0, weight = 0;
      for (const size_t part : chosen) sum += p.sums[part], weight += p.weights[part];
      v.push_back(weight > 0 ? sum / weight : 0);
    }
  }
  return values;
}

}  // namespace

double CurvePoint::value() const {
  double sum = 0, weight = 0;
  for (size_t i = 0; i < sums.size(); ++i) sum += sums[i], weight += weights[i];
  return weight > 0 ? sum / weight : 0;
}

Line fit_line(const std::vector<double>& x, const std::vector<double>& y,
              const std::vector<double>& weights) {
  double w = 0, mean_x = 0, mean_y = 0, xx = 0, xy = 0;
  for (size_t i = 0; i < x.size(); ++i)
    w += weights[i], mean_x += weights[i] * x[i], mean_y += weights[i] * y[i];
  mean_x /= w, mean_y /= w;
  for (size_t i = 0; i < x.size(); ++i) {
    const double d = x[i] - mean_x;
    xx += weights[i] * d * d, xy += weights[i] * d * (y[i] - mean_y);
  }
  return {xy / xx, mean_y - xy / xx * mean_x};
}

CurveFit fit_curve(const std::vector<CurvePoint>& points) {
  CurveFit fit;
  if (points.empty()) return fit;
  const std::vector<std::vector<double>> values = resample(points);
  std::vector<size_t> usable;
  std::vector<double> log_x, weights;
  for (size_t k = 0; k < points.size(); ++k) {
    std::vector<double> of_point;
    for (const auto& v : values) of_point.push_back(v[k]);
    fit.value_95.push_back(interval_95(std::move(of_point)));
    const Interval& i = fit.value_95.back();
    if (!(i.low > 0) || !(points[k].value() > 0) || !(points[k].x > 0)) continue;
    usable.push_back(k);
    log_x.push_back(std::log(points[k].x));
    // A curve without any spread has equal weights.
    const double width = std::max(1e-6, std::log(i.high / i.low));
    weights.push_back(1 / (width * width));
  }
  if (usable.size() < 3) return fit;
  const auto [least, most] = std::minmax_element(log_x.begin(), log_x.end());
  if (*most - *least < std::log(4.0)) return fit;
  const auto line_of = [&](const auto& value) {
    std::vector<double> log_y;
    for (const size_t k : usable)
      log_y.push_back(0.5 * std::log(std::max(value(k), 1e-3 * points[k].value())));
    return fit_line(log_x, log_y, weights);
  };
  const Line line = line_of([&](size_t k) { return points[k].value(); });
  std::vector<double> slopes;
  for (const auto& v : values) slopes.push_back(line_of([&](size_t k) { return v[k]; }).slope);
  fit.slope = SlopeFit{line.slope, interval_95(std::move(slopes)), line.intercept};
  return fit;
}

}  // namespace duet
