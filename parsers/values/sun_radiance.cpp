#include "values/sun_radiance.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "math/angles.h"
#include "values/color.h"

namespace duet {

namespace {

/// Values at equal steps of the wavelength in nm: linear between them, zero beyond.
struct Curve {
  double first, step;
  std::span<const double> values;

  double operator()(double wavelength) const {
    const double t = (wavelength - first) / step;
    if (!(t >= 0 && t <= double(values.size() - 1))) return 0;
    const size_t i = std::min(size_t(t), values.size() - 2);
    return values[i] + (values[i + 1] - values[i]) * (t - double(i));
  }
};

constexpr double kFirst = 380, kLast = 750, kStep = 5;

/// Radiance of the sun above the atmosphere, W/(cm²·µm·sr), which is 10 W/(m²·nm·sr). Table 2 of
/// the paper. It ends before oxygen and carbon dioxide, the paper's "mixed gases", absorb any.
constexpr double kSunValues[] = {
    1655.90, 1623.37, 2112.75, 2588.82, 2582.91, 2423.23, 2676.05, 2965.83, 3054.54, 3005.75,
    3066.37, 2883.04, 2871.21, 2782.50, 2710.06, 2723.36, 2636.13, 2550.38, 2506.02, 2531.16,
    2535.59, 2513.42, 2463.15, 2417.32, 2368.53, 2321.21, 2282.77, 2233.98, 2197.02, 2152.67,
    2109.79, 2072.83, 2024.04, 1987.08, 1942.72, 1907.24, 1862.89, 1825.92};
constexpr Curve kSun{kFirst, 10, kSunValues};

/// Absorption of ozone per cm: Table 2 between its wavelengths, too, from the paper's source
/// (Iqbal, "An Introduction to Solar Radiation", 1983).
constexpr double kOzoneNearViolet[] = {0, 0.003};
constexpr double kOzoneMiddle[] = {0.003, 0.003, 0.004, 0.006, 0.008, 0.009, 0.012, 0.014, 0.017,
                                   0.021, 0.025, 0.030, 0.035, 0.040, 0.045, 0.048, 0.057, 0.063,
                                   0.070, 0.075, 0.080, 0.085, 0.095, 0.103, 0.110, 0.120, 0.122,
                                   0.120, 0.118, 0.115, 0.120, 0.125, 0.130, 0.120};
constexpr double kOzoneRed[] = {0.120, 0.105, 0.090, 0.079, 0.067, 0.057, 0.048, 0.036,
                                0.028, 0.023, 0.018, 0.014, 0.011, 0.010, 0.009};

double ozone(double wavelength) {
  if (wavelength < 445) return Curve{355, 90, kOzoneNearViolet}(wavelength);
  if (wavelength < 610) return Curve{445, 5, kOzoneMiddle}(wavelength);
  return Curve{610, 10, kOzoneRed}(wavelength);
}

/// Absorption of water vapour per cm.
constexpr double kWaterValues[] = {0.016, 0.024, 0.0125, 1, 0.87, 0.061, 0.001};
constexpr Curve kWater{690, 10, kWaterValues};

/// The share of light that comes through `mass` times the air above the place.
double transmittance(double wavelength, double turbidity, double mass) {
  const double micrometres = wavelength / 1000;
  const double rayleigh = 0.008735 * std::pow(micrometres, -4.08);
  // Ångström's formula for dust and droplets.
  const double beta = 0.04608365822050 * turbidity - 0.04586025928522;
  const double aerosol = beta * std::pow(micrometres, -1.3);
  const double vapour = 2 * kWater(wavelength);
  const double water = 0.2385 * vapour / std::pow(1 + 20.07 * vapour * mass, 0.45);
  return std::exp(-mass * (rayleigh + aerosol + 0.35 * ozone(wavelength) + water));
}

}  // namespace

Spectrum sun_irradiance_0x(double turbidity, double zenith) {
  // Kasten's formula.
  const double mass = 1 / (std::cos(zenith) + 0.15 * std::pow(93.885 - zenith * kDegrees, -1.253));
  std::vector<SpectrumSample> radiance{{kFirst - kStep, 0}};
  for (double w = kFirst; w <= kLast; w += kStep)
    radiance.push_back({w, 10 * kSun(w) * transmittance(w, turbidity, mass)});
  radiance.push_back({kLast + kStep, 0});
  const double half = kSunAperture0x * std::numbers::pi / 360;
  const double solid_angle = 4 * std::numbers::pi * std::pow(std::sin(half / 2), 2);
  return spectrum_to_rgb(radiance, ColorMeaning::emission) * float(solid_angle);
}

SunDisk sun_disk_0x(const std::array<double, 3>& sun, double turbidity, double stretch) {
  const auto& [x, y, z] = sun;
  const double across = std::hypot(x, y), zenith = std::atan2(across, z);
  SunDisk disk;
  disk.irradiance = sun_irradiance_0x(turbidity, zenith);
  if (across > 0) {
    const double r = std::sin(zenith * stretch) / across;
    disk.direction = {x * r, y * r, std::cos(zenith * stretch)};
  }
  return disk;
}

Matrix4 y_up_sky() {
  Matrix4 m;
  m[0] = {1, 0, 0, 0};
  m[1] = {0, 0, 1, 0};
  m[2] = {0, -1, 0, 0};
  return m;
}

LightDescription directional_sun(const SunDisk& disk, double scale, const LightDescription& sky) {
  const auto [x, y, z] = sky.to_world.turned(disk.direction);
  LightDescription out = sky;
  out.model = DirectionalLight{disk.irradiance * float(scale)};
  out.to_world = Matrix4::look_along({}, {-x, -y, -z}).value_or(Matrix4{});
  return out;
}

}  // namespace duet
