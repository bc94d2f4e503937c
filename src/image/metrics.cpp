#include "image/metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace duet {

namespace {

/// Reads the three colours of a pixel wherever they stand among its channels.
class Colours {
 public:
  explicit Colours(const Image& image) : image_(image) {
    const int y = image.find_channel("Y");
    index_ = {image.find_channel("R"), image.find_channel("G"), image.find_channel("B")};
    if (index_[0] < 0 && index_[1] < 0 && index_[2] < 0 && y >= 0) index_ = {y, y, y};
    if (index_[0] < 0 || index_[1] < 0 || index_[2] < 0)
      throw std::invalid_argument("the image has no channels R, G, B");
  }
  double operator()(size_t pixel, int channel) const {
    return image_.data[pixel * image_.channels.size() + size_t(index_[channel])];
  }

 private:
  const Image& image_;
  std::array<int, 3> index_;
};

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
  const size_t pixels = size_t(image.width) * image.height;
  ImageMetrics m;
  std::vector<double> relative;  // per pixel: mean over the channels of the relative squared error
  relative.reserve(pixels);
  double squares = 0, absolute = 0;
  std::array<double, 3> sum_a{}, sum_b{}, sum_variance{};
  for (size_t i = 0; i < pixels; ++i) {
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
      squares += d * d;
      absolute += std::abs(d);
      r += d * d / (b(i, c) * b(i, c) + 0.01) / 3;
      sum_a[c] += a(i, c), sum_b[c] += b(i, c);
      if (variance) sum_variance[c] += std::max(0.0, (*variance)(i, c));
    }
    relative.push_back(r);
  }
  if (relative.empty()) return m;
  const double values = 3.0 * double(relative.size());
  const double mean_b = (sum_b[0] + sum_b[1] + sum_b[2]) / values;
  m.rmse = std::sqrt(squares / values);
  m.relative_rmse = m.rmse / mean_b;
  m.mae = absolute / values;
  for (int c = 0; c < 3; ++c) m.mean_ratio[c] = sum_a[c] / sum_b[c];
  std::sort(relative.begin(), relative.end());
  for (const double r : relative) m.relmse += r;
  m.relmse /= double(relative.size());
  const size_t kept = std::max<size_t>(1, size_t(double(relative.size()) * 0.999));
  for (size_t i = 0; i < kept; ++i) m.relmse_trimmed += relative[i];
  m.relmse_trimmed /= double(kept);
  if (!variance) return m;

  // The noise of both images, in units of the variance of one sample.
  const double per_sample = 1 / noise->image_spp + 1 / noise->reference_spp;
  double bias = 0;
  for (int c = 0; c < 3; ++c) {
    const double systematic = noise->systematic * sum_b[c];
    const double error = std::sqrt(sum_variance[c] * per_sample + systematic * systematic);
    const double z = error > 0 ? (sum_a[c] - sum_b[c]) / error : 0;
    if (std::abs(z) > std::abs(bias)) bias = z;
  }
  m.bias = bias;
  // A pixel that happened to be equal in all samples has no variance; it is given that of an error
  // of one percent of the mean.
  const double floor = std::pow(0.01 * mean_b, 2);
  const double level = 1 - std::pow(1 - 0.01, 1 / double(pixels));
  size_t good = 0, counted = 0;
  double z_squares = 0;
  for (size_t i = 0; i < pixels; ++i)
    for (int c = 0; c < 3; ++c) {
      const double d = a(i, c) - b(i, c);
      if (!std::isfinite(b(i, c))) continue;
      ++counted;
      if (!std::isfinite(d)) continue;
      const double z = std::abs(d) / std::sqrt(std::max((*variance)(i, c), floor) * per_sample);
      good += std::erfc(z / std::sqrt(2.0)) > level;
      z_squares += z * z;
    }
  m.z_share = double(good) / double(std::max<size_t>(1, counted));
  m.z_rms = std::sqrt(z_squares / double(std::max<size_t>(1, counted)));
  return m;
}

std::vector<uint8_t> difference_image(const Image& image, const Image& reference, double scale) {
  const Colours a(image), b(reference);
  const size_t pixels = size_t(image.width) * image.height;
  std::vector<uint8_t> bytes(3 * pixels);
  for (size_t i = 0; i < pixels; ++i) {
    const auto luminance = [&](const Colours& c) {
      return 0.212671 * c(i, 0) + 0.715160 * c(i, 1) + 0.072169 * c(i, 2);
    };
    const double d = luminance(a) - luminance(b);
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

}  // namespace duet
