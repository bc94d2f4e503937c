#include "image/flip.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "image/colours.h"
#include "image/flip_map.h"

namespace duet {

namespace {

/// Linear colours, each put through `display`.
template <class Display>
FlipColours displayed(const Image& image, const Display& display) {
  const Colours colours(image);
  FlipColours rgb(colours.pixels());
  for (size_t i = 0; i < rgb.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double v = colours(i, c);
      rgb[i][size_t(c)] = std::isnan(v) ? 0.0f : float(std::clamp(display(v), 0.0, 1.0));
    }
  return rgb;
}

void check_sizes(const Image& image, const Image& reference) {
  if (image.width != reference.width || image.height != reference.height)
    throw std::invalid_argument("FLIP compares images of equal size");
}

FlipResult with_mean(std::vector<float> map) {
  const double sum = std::accumulate(map.begin(), map.end(), 0.0);
  return {map.empty() ? 0 : sum / double(map.size()), std::move(map)};
}

/// The tone curve of ACES films in Narkowicz's fit, (n₂ x² + n₁ x) / (d₂ x² + d₁ x + d₀), with his
/// exposure of 0.6 included.
constexpr double kN2 = 2.51 * 0.36, kN1 = 0.03 * 0.6, kD2 = 2.43 * 0.36, kD1 = 0.59 * 0.6,
                 kD0 = 0.14;
double tone_curve(double x) {
  x = std::max(0.0, x);
  if (std::isinf(x)) return kN2 / kD2;
  return (kN2 * x + kN1) * x / ((kD2 * x + kD1) * x + kD0);
}

}  // namespace

FlipResult ldr_flip(const Image& image, const Image& reference) {
  check_sizes(image, reference);
  const auto as_is = [](double v) { return v; };
  return with_mean(
      flip_map(displayed(image, as_is), displayed(reference, as_is), image.width, image.height));
}

std::optional<FlipExposures> flip_exposures(const Image& reference) {
  const Colours colours(reference);
  std::vector<double> luminances(colours.pixels());
  for (size_t i = 0; i < luminances.size(); ++i) {
    const double y = colours.luminance(i);
    luminances[i] = std::isfinite(y) ? std::max(0.0, y) : 0;
  }
  if (luminances.empty()) return std::nullopt;
  std::sort(luminances.begin(), luminances.end());
  const size_t half = luminances.size() / 2;
  const double most = luminances.back();
  const double median =
      luminances.size() % 2 ? luminances[half] : 0.5 * (luminances[half - 1] + luminances[half]);
  if (!(most > 0)) return std::nullopt;
  // Where the tone curve reaches 0.85: (0.85 d₂ − n₂) x² + (0.85 d₁ − n₁) x + 0.85 d₀ = 0.
  constexpr double level = 0.85;
  constexpr double a = level * kD2 - kN2, b = level * kD1 - kN1, c = level * kD0;
  const double bright = (-b - std::sqrt(b * b - 4 * a * c)) / (2 * a);
  FlipExposures e;
  e.start = std::log2(bright / most);
  e.stop = std::log2(bright / std::max(median, 1e-6));
  e.count = std::max(2, int(std::ceil(e.stop - e.start)));
  return e;
}

std::optional<FlipResult> hdr_flip(const Image& image, const Image& reference, int threads) {
  check_sizes(image, reference);
  const auto exposures = flip_exposures(reference);
  if (!exposures) return std::nullopt;
  std::vector<std::vector<float>> maps(size_t(exposures->count));
  parallel_for(maps.size(), threads, [&](size_t i) {
    const double step = (exposures->stop - exposures->start) / (exposures->count - 1);
    const double scale = std::exp2(exposures->start + double(i) * step);
    const auto display = [&](double v) { return tone_curve(scale * v); };
    maps[i] = flip_map(displayed(image, display), displayed(reference, display), image.width,
                       image.height);
  });
  std::vector<float>& worst = maps[0];
  for (const std::vector<float>& m : maps)
    for (size_t i = 0; i < worst.size(); ++i) worst[i] = std::max(worst[i], m[i]);
  return with_mean(std::move(worst));
}

}  // namespace duet
