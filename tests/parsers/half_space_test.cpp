#include "values/half_space.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace duet;

namespace {

/// The share of a beam along the normal that leaves again, by following it.
double followed(double albedo, double g, double eta, int walks) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> next(0, 1);
  double out = 0;
  for (int i = 0; i < walks; ++i) {
    double depth = 0, z = 1, weight = 1;  // z: cosine with the way in
    for (;;) {
      depth -= std::log(1 - next(engine)) * z;
      if (depth < 0) {
        // From the inside to the surface.
        const double cosine = -z, cos2_t = 1 - eta * eta * (1 - z * z);
        double f = 1;
        if (cos2_t > 0) {
          const double c = std::sqrt(cos2_t);
          const double across = (eta * cosine - c) / (eta * cosine + c);
          const double along = (cosine - eta * c) / (cosine + eta * c);
          f = 0.5 * (across * across + along * along);
        }
        out += weight * (1 - f);
        weight *= f;
        depth = -depth, z = -z;  // exponential ways have no memory
      }
      weight *= albedo;
      if (weight < 0.1) {
        if (next(engine) > weight) break;
        weight = 1;
      }
      const double x = next(engine);
      const double cosine =
          g == 0 ? 2 * x - 1
                 : (1 + g * g - std::pow((1 - g * g) / (1 - g + 2 * g * x), 2)) / (2 * g);
      const double phi = 2 * M_PI * next(engine);
      z = std::clamp(z * cosine + std::sqrt(std::max((1 - z * z) * (1 - cosine * cosine), 0.0)) *
                                      std::cos(phi),
                     -1.0, 1.0);
    }
  }
  return out / walks;
}

}  // namespace

TEST_CASE("a half-space reflects what is found by following light") {
  for (const double eta : {1.0, 1.33, 1.5})
    for (const double g : {0.0, 0.5, 0.8})
      for (const double albedo : {0.3, 0.8, 0.95, 0.99, 0.999}) {
        CAPTURE(eta);
        CAPTURE(g);
        CAPTURE(albedo);
        CHECK(std::abs(half_space_reflectance(albedo, g, eta) - followed(albedo, g, eta, 20000)) <
              (eta > 1.2 ? 0.02 : 0.045) + 3 * 0.5 / std::sqrt(20000));
      }
  CHECK(half_space_reflectance(1, 0, 1.5) == doctest::Approx(1));
  CHECK(half_space_reflectance(0, 0.5, 1.5) == 0);
}

TEST_CASE("the albedo of a half-space is that of its reflectance") {
  for (const double eta : {1.0, 1.33, 1.5})
    for (const double g : {-0.3, 0.0, 0.7})
      for (const double reflectance : {0.05, 0.3, 0.6, 0.9}) {
        const double albedo = half_space_albedo(reflectance, g, eta);
        CHECK(half_space_reflectance(albedo, g, eta) == doctest::Approx(reflectance).epsilon(1e-6));
      }
  CHECK(half_space_albedo(0, 0, 1.3) == doctest::Approx(0));
  CHECK(half_space_albedo(2, 0, 1.3) == doctest::Approx(1));
}
