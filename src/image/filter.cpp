#include "image/filter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace duet {

namespace {

/// Mitchell & Netravali, "Reconstruction Filters in Computer Graphics", 1988, eq. 8.
double cubic(double x, double b, double c) {
  const double x2 = x * x, x3 = x2 * x;
  if (x < 1) return ((12 - 9 * b - 6 * c) * x3 + (-18 + 12 * b + 6 * c) * x2 + (6 - 2 * b)) / 6;
  if (x < 2)
    return ((-b - 6 * c) * x3 + (6 * b + 30 * c) * x2 + (-12 * b - 48 * c) * x + (8 * b + 24 * c)) /
           6;
  return 0;
}

/// Mitsuba 3 evaluates its Gaussian by a polynomial of degree 9 in the squared distance that is off
/// by up to 4e-4. These are the coefficients fitted to its values, for a distance in units of the
/// radius (four standard deviations).
double mitsuba_gaussian(double x) {
  constexpr double kCoefficients[] = {0.99925642, -7.9632391, 31.289522,  -79.150905, 140.02915,
                                      -176.14001, 154.37296,  -89.359411, 30.608326,  -4.6856463};
  const double t = x * x;
  double sum = 0;
  for (int i = 9; i >= 0; --i) sum = sum * t + kCoefficients[i];
  return std::max(0.0, sum);
}

double gaussian(double x, double stddev) {
  return std::exp(-x * x / (2 * stddev * stddev));
}

double sinc(double x) {
  return x == 0 ? 1 : std::sin(std::numbers::pi * x) / (std::numbers::pi * x);
}

}  // namespace

double filter_radius(const FilterDescription& f) {
  switch (f.kind) {
    case FilterKind::box:
      return f.radius;
    case FilterKind::tent:
      return f.radius;
    case FilterKind::gaussian:
      return 4 * f.stddev;
    case FilterKind::mitchell:
    case FilterKind::catmullrom:
      return 2;
    case FilterKind::lanczos:
      return f.lobes;
  }
  return 0;
}

double evaluate_filter(const FilterDescription& f, double distance,
                       const std::optional<double>& reach) {
  const double x = std::abs(distance), r = reach.value_or(filter_radius(f));
  if (x > r) return 0;
  switch (f.kind) {
    case FilterKind::box:
      return 1;
    case FilterKind::tent:
      return 1 - x / r;
    case FilterKind::gaussian:
      if (reach) return gaussian(x, f.stddev) - gaussian(r, f.stddev);
      return mitsuba_gaussian(x / r);
    case FilterKind::mitchell:
      return cubic(2 * x / r, f.b, f.c);
    case FilterKind::catmullrom:
      return cubic(2 * x / r, 0, 0.5);
    case FilterKind::lanczos:
      return sinc(x) * sinc(x / f.lobes);
  }
  return 0;
}

FilterProfile::FilterProfile(const FilterDescription& f, const std::optional<double>& reach) {
  const double r = reach.value_or(filter_radius(f));
  radius_ = float(r);
  scale_ = float(kResolution / r);
  for (int i = 0; i <= kResolution; ++i)
    table_[i] = float(evaluate_filter(f, r * i / kResolution, reach));
}

ReconstructionFilter::ReconstructionFilter(const FilterDescription& f)
    : along_x_(f, f.reach_x), along_y_(f, f.reach_y) {
  const double r = double(std::max(along_x_.radius(), along_y_.radius()));
  border_ = std::max(0, int(std::ceil(r - 0.5 - 1e-6)));
  is_unit_box_ = f.kind == FilterKind::box && border_ == 0;
}

}  // namespace duet
