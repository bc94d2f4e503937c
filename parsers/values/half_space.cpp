#include "values/half_space.h"

#include <algorithm>
#include <cmath>

namespace duet {

namespace {

/// Reflectance of a smooth interface for light from the inside, whose index is `eta` over that of
/// the outside.
double inner_fresnel(double cosine, double eta) {
  const double cos2_t = 1 - eta * eta * (1 - cosine * cosine);
  if (!(cos2_t > 0)) return 1;
  const double cos_t = std::sqrt(cos2_t);
  const double across = (eta * cosine - cos_t) / (eta * cosine + cos_t);
  const double along = (cosine - eta * cos_t) / (cosine + eta * cos_t);
  return 0.5 * (across * across + along * along);
}

/// The same for diffuse light.
double inner_diffuse_fresnel(double eta) {
  constexpr int n = 2000;
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += inner_fresnel(std::sqrt((i + 0.5) / n), eta);
  return sum / n;
}

/// What evenly scattering media reflect without a surface: s² is the share that is absorbed at each
/// scattering.
double beam_reflectance(double s) {
  const double r = (1 - s) / (1 + s), albedo = 1 - s * s;
  const double h = 1 / (1 - albedo * (r + 0.5 * (1 - 2 * r) * std::log(2.0)));
  return 1 - s * h;
}
double diffuse_reflectance(double s) {
  return (1 - s) * (1 - 0.139 * s) / (1 + 1.17 * s);
}

double reflectance_of(double albedo, double g, double returned) {
  const double s = std::sqrt((1 - albedo) / (1 - albedo * g));
  return beam_reflectance(s) * (1 - returned) / (1 - diffuse_reflectance(s) * returned);
}

}  // namespace

double half_space_reflectance(double albedo, double g, double eta) {
  return reflectance_of(albedo, g, inner_diffuse_fresnel(eta));
}

double half_space_albedo(double reflectance, double g, double eta) {
  const double returned = inner_diffuse_fresnel(eta);
  double low = 0, high = 1;
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    (reflectance_of(middle, g, returned) < reflectance ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace duet
