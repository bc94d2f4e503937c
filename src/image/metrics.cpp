#include "image/metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "image/colours.h"

namespace duet {

double brightest_share(std::vector<double> values) {
  const size_t kept = trimmed_count(values.size());
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(kept), values.end());
  double rest = 0, bright = 0;
  for (size_t i = 0; i < values.size(); ++i) (i < kept ? rest : bright) += values[i];
  return rest + bright > 0 ? bright / (rest + bright) : 0;
}

size_t trimmed_count(size_t pixels) {
  return std::max<size_t>(1, size_t(double(pixels) * (1 - kOutlierShare)));
}

namespace {

/// Sums over the pixels whose values are finite in both images.
struct PixelSums {
  double squares = 0, absolute = 0;
  std::array<double, 3> image{}, reference{}, variance{};
  std::vector<double> relative;    ///< per pixel: relative squared error, mean over the channels
  std::vector<double> luminances;  ///< of the image
  double mean_reference() const {
    return (reference[0] + reference[1] + reference[2]) / (3.0 * double(relative.size()));
  }
};

/// Counts the pixels of the image that are not as they should be, and adds up the others.
/// `variance` may be null.
PixelSums sum_pixels(const Colours& a, const Colours& b, const Colours* variance, ImageMetrics& m) {
  PixelSums sums;
  sums.relative.reserve(a.pixels());
  sums.luminances.reserve(a.pixels());
  for (size_t i = 0; i < a.pixels(); ++i) {
    bool nan = false, infinite = false, negative = false, usable = true;
    for (int c = 0; c < 3; ++c) {
      nan |= std::isnan(a(i, c));
      infinite |= std::isinf(a(i, c));
      negative |= a(i, c) < 0;
      usable &= std::isfinite(a(i, c)) && std::isfinite(b(i, c));
    }
    m.nan_pixels += nan, m.infinite_pixels += infinite, m.negative_pixels += negative;
    if (!usable) continue;
    double r = 0;
    for (int c = 0; c < 3; ++c) {
      const double d = a(i, c) - b(i, c);
      sums.squares += d * d;
      sums.absolute += std::abs(d);
      r += d * d / (b(i, c) * b(i, c) + 0.01) / 3;
      sums.image[c] += a(i, c), sums.reference[c] += b(i, c);
      if (variance) sums.variance[c] += std::max(0.0, (*variance)(i, c));
    }
    sums.relative.push_back(r);
    sums.luminances.push_back(a.luminance(i));
  }
  return sums;
}

/// The mean relative squared error with and without the worst pixels.
void find_relative_error(std::vector<double> relative, ImageMetrics& m) {
  std::sort(relative.begin(), relative.end());
  const size_t kept = trimmed_count(relative.size());
  double kept_sum = 0, total_sum = 0;
  for (size_t i = 0; i < relative.size(); ++i) (i < kept ? kept_sum : total_sum) += relative[i];
  total_sum += kept_sum;
  m.relmse = total_sum / double(relative.size());
  m.relmse_trimmed = kept_sum / double(kept);
  m.worst = total_sum > 0 ? 1 - kept_sum / total_sum : 0;
}

/// a / b, where what there is none of on either side is the same on both.
double ratio_of(double a, double b, double if_both_zero) {
  return a == 0 && b == 0 ? if_both_zero : a / b;
}

/// The difference of the means over its standard error, the worst channel; `per_sample` is the
/// noise of both images in units of the variance of one sample.
double bias_of(const PixelSums& sums, double systematic_error, double per_sample) {
  double bias = 0;
  for (size_t c = 0; c < 3; ++c) {
    const double systematic = systematic_error * sums.reference[c];
    const double error = std::sqrt(sums.variance[c] * per_sample + systematic * systematic);
    const double z = ratio_of(sums.image[c] - sums.reference[c], error, 0);
    if (std::abs(z) > std::abs(bias)) bias = z;
  }
  return bias;
}

/// The differences of all values in standard errors. A pixel that happened to be equal in all
/// samples has no variance; it is given `floor`.
void find_z(const Colours& a, const Colours& b, const Colours& variance, double per_sample,
            double floor, ImageMetrics& m) {
  const double level = 1 - std::pow(1 - 0.01, 1 / double(a.pixels()));
  size_t good = 0, counted = 0;
  double z_squares = 0;
  for (size_t i = 0; i < a.pixels(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double d = a(i, c) - b(i, c);
      if (!std::isfinite(b(i, c))) continue;
      ++counted;
      if (!std::isfinite(d)) continue;
      const double error = std::sqrt(std::max(variance(i, c), floor) * per_sample);
      const double z = ratio_of(std::abs(d), error, 0);
      good += std::erfc(z / std::sqrt(2.0)) > level;
      z_squares += z * z;
    }
  m.z_share = double(good) / double(std::max<size_t>(1, counted));
  m.z_rms = std::sqrt(z_squares / double(std::max<size_t>(1, counted)));
}

}  // namespace

ImageMetrics compare_images(const Image& image, const Image& reference,
                            const std::optional<NoiseModel>& noise) {
  if (image.width != reference.width || image.height != reference.height)
    throw std::invalid_argument(fmt::format("the image is {}x{}, the reference {}x{}", image.width,
                                            image.height, reference.width, reference.height));
  const Colours a(image), b(reference);
  std::optional<Colours> variance;
  if (noise) {
    if (noise->variance->width != image.width || noise->variance->height != image.height)
      throw std::invalid_argument("the variance image has another size");
    variance.emplace(*noise->variance);
  }
  ImageMetrics m;
  PixelSums sums = sum_pixels(a, b, variance ? &*variance : nullptr, m);
  if (sums.relative.empty()) return m;
  const double values = 3.0 * double(sums.relative.size()), mean_b = sums.mean_reference();
  m.rmse = std::sqrt(sums.squares / values);
  m.relative_rmse = ratio_of(m.rmse, mean_b, 0);
  m.mae = sums.absolute / values;
  for (size_t c = 0; c < 3; ++c) m.mean_ratio[c] = ratio_of(sums.image[c], sums.reference[c], 1);
  find_relative_error(std::move(sums.relative), m);
  m.firefly = brightest_share(std::move(sums.luminances));
  if (!variance) return m;
  const double per_sample = 1 / noise->image_spp + 1 / noise->reference_spp;
  m.bias = bias_of(sums, noise->systematic, per_sample);
  // An error of one percent of the mean.
  find_z(a, b, *variance, per_sample, std::pow(0.01 * mean_b, 2), m);
  return m;
}

std::vector<uint8_t> difference_image(const Image& image, const Image& reference, double scale) {
  const Colours a(image), b(reference);
  const size_t pixels = size_t(image.width) * image.height;
  std::vector<uint8_t> bytes(3 * pixels);
  for (size_t i = 0; i < pixels; ++i) {
    const double d = a.luminance(i) - b.luminance(i);
    if (!std::isfinite(d)) {  // green: no number
      bytes[3 * i + 1] = 255;
      continue;
    }
    const double t = std::clamp(scale > 0 ? d / scale : 0.0, -1.0, 1.0);
    const auto fade = uint8_t(std::lround(255 * (1 - std::abs(t))));
    bytes[3 * i + 0] = t >= 0 ? 255 : fade;
    bytes[3 * i + 1] = fade;
    bytes[3 * i + 2] = t <= 0 ? 255 : fade;
  }
  return bytes;
}

std::vector<uint8_t> false_colours(const std::vector<float>& values) {
  static constexpr uint8_t stops[][3] = {{0, 0, 0},      {40, 16, 84},    {100, 26, 128},
                                         {160, 44, 116}, {212, 68, 84},   {242, 110, 60},
                                         {252, 164, 64}, {252, 214, 118}, {255, 250, 210}};
  constexpr int last = int(std::size(stops)) - 1;
  std::vector<uint8_t> bytes(3 * values.size());
  for (size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) {
      bytes[3 * i + 1] = 255;
      continue;
    }
    const float t = std::clamp(values[i], 0.0f, 1.0f) * float(last);
    const int k = std::min(int(t), last - 1);
    for (int c = 0; c < 3; ++c) {
      const float low = stops[k][c], high = stops[k + 1][c];
      bytes[3 * i + size_t(c)] = uint8_t(std::lround(low + (t - float(k)) * (high - low)));
    }
  }
  return bytes;
}

std::vector<float> relative_differences(const Image& image, const Image& reference) {
  const Colours a(image), b(reference);
  double sum = 0;
  for (size_t i = 0; i < b.pixels(); ++i)
    if (std::isfinite(b.luminance(i))) sum += b.luminance(i);
  const double floor = 0.01 * sum / double(std::max<size_t>(1, b.pixels()));
  std::vector<float> values(b.pixels());
  for (size_t i = 0; i < values.size(); ++i) {
    const double d = std::abs(a.luminance(i) - b.luminance(i));
    values[i] = d == 0 ? 0.0f : float(d / (std::abs(b.luminance(i)) + floor));
  }
  return values;
}

}  // namespace duet
