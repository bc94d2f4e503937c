#include "values/color.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "values/color_tables.h"

namespace duet {

namespace {

/// Linear interpolation in a table over the CIE wavelengths, at a wavelength within them.
double look_up(const std::array<float, kCieSamples>& table, double wavelength) {
  const double t = (wavelength - kCieFirst) / kCieStep;
  const int i = std::clamp(int(t), 0, kCieSamples - 2);
  const double w = t - i;
  return double(table[i]) * (1 - w) + double(table[i + 1]) * w;
}

using Triple = std::array<double, 3>;

Triple color_matching(double wavelength) {
  return {look_up(kCieX, wavelength), look_up(kCieY, wavelength), look_up(kCieZ, wavelength)};
}

/// Integral of ȳ: makes the luminance of a spectrum of ones 1.
double luminance_normalization() {
  double sum = 0;
  for (float y : kCieY) sum += kCieStep * double(y);
  return 1 / sum;
}

/// Makes the luminance of D65 1. This is the constant of Mitsuba 3; the tables say 98.888, so that
/// a reflectance of one half at all wavelengths becomes 0.4994 in Mitsuba, and therefore here.
constexpr double kDaylightNormalization = 1 / 98.99741751876255;

/// ITU-R BT.709 primaries with white point D65.
Triple xyz_to_linear_srgb(const Triple& c) {
  return {3.240479 * c[0] - 1.537150 * c[1] - 0.498535 * c[2],
          -0.969256 * c[0] + 1.875991 * c[1] + 0.041556 * c[2],
          0.055648 * c[0] - 0.204043 * c[1] + 1.057311 * c[2]};
}

/// Walks through a tabulated spectrum at increasing wavelengths.
class Interpolator {
 public:
  explicit Interpolator(std::span<const SpectrumSample> samples) : samples_(samples) {}
  double operator()(double wavelength) {
    while (next_ + 1 < samples_.size() && samples_[next_].wavelength < wavelength) ++next_;
    const SpectrumSample &a = samples_[next_ - 1], &b = samples_[next_];
    return a.value +
           (b.value - a.value) * (wavelength - a.wavelength) / (b.wavelength - a.wavelength);
  }

 private:
  std::span<const SpectrumSample> samples_;
  size_t next_ = 1;
};

/// Adds up a spectrum's colour, wavelength by wavelength.
class ColorSum {
 public:
  ColorSum(std::span<const SpectrumSample> samples, ColorMeaning meaning)
      : value_(samples), meaning_(meaning) {}

  /// Wavelengths must increase.
  void add(double wavelength, double weight) {
    weight *= value_(wavelength);
    if (meaning_ != ColorMeaning::emission)
      weight *= look_up(kD65, wavelength) * kDaylightNormalization;
    const Triple c = color_matching(wavelength);
    for (int k = 0; k < 3; ++k) xyz_[k] += weight * c[k];
  }

  Spectrum rgb(double scale) const {
    const Triple linear = xyz_to_linear_srgb({xyz_[0] * scale, xyz_[1] * scale, xyz_[2] * scale});
    const double upper = meaning_ == ColorMeaning::reflectance ? 1 : INFINITY;
    Spectrum out;
    for (int k = 0; k < 3; ++k) out[k] = float(std::clamp(linear[k], 0.0, upper));
    return out;
  }

 private:
  Interpolator value_;
  ColorMeaning meaning_;
  Triple xyz_{};
};

}  // namespace

Spectrum spectrum_to_rgb(std::span<const SpectrumSample> samples, ColorMeaning meaning) {
  if (samples.size() < 2) return Spectrum(0.0f);
  const double first = std::max(samples.front().wavelength, kCieFirst);
  const double last = std::min(samples.back().wavelength, kCieLast);
  if (!(first < last)) return Spectrum(0.0f);

  // Between these wavelengths all factors are linear.
  std::vector<double> knots{first};
  for (const SpectrumSample& s : samples)
    if (s.wavelength > first && s.wavelength < last) knots.push_back(s.wavelength);
  for (int i = 0; i < kCieSamples; ++i) {
    const double w = kCieFirst + i * kCieStep;
    if (w > first && w < last) knots.push_back(w);
  }
  knots.push_back(last);
  std::sort(knots.begin(), knots.end());

  ColorSum sum(samples, meaning);
  // Simpson's rule is exact for the product of three linear functions.
  for (size_t i = 0; i + 1 < knots.size(); ++i) {
    const double a = knots[i], b = knots[i + 1];
    sum.add(a, (b - a) / 6), sum.add((a + b) / 2, (b - a) * 4 / 6), sum.add(b, (b - a) / 6);
  }
  return sum.rgb(luminance_normalization());
}

Spectrum stepped_spectrum_to_rgb(std::span<const SpectrumSample> samples, ColorMeaning meaning) {
  if (samples.size() < 2) return Spectrum(0.0f);
  constexpr int kSteps = 1000;
  /// Mitsuba 3's integral of ȳ; the weight of a step makes up for what it lacks.
  constexpr double kLuminance = 106.7502593994140625;
  ColorSum sum(samples, meaning);
  for (int i = 0; i < kSteps; ++i) {
    const double w = kCieFirst + i * (kCieLast - kCieFirst) / (kSteps - 1);
    if (w >= samples.front().wavelength && w <= samples.back().wavelength) sum.add(w, 1);
  }
  return sum.rgb((kCieLast - kCieFirst) / kSteps / kLuminance);
}

Spectrum equal_energy_rgb(double value) {
  const Triple white = xyz_to_linear_srgb({value, value, value});
  return {float(white[0]), float(white[1]), float(white[2])};
}

std::vector<SpectrumSample> blackbody_spectrum(double kelvin, double scale) {
  const double c = 299792458, k = 1.3806488e-23, h = 6.62606957e-34;
  std::vector<SpectrumSample> samples;
  for (int nm = int(kCieFirst); nm <= int(kCieLast); ++nm) {
    const double l = nm * 1e-9;
    const double per_meter =
        2 * h * c * c / (std::pow(l, 5) * std::expm1(h * c / (l * k * kelvin)));
    samples.push_back({double(nm), scale * per_meter * 1e-9});
  }
  return samples;
}

}  // namespace duet
