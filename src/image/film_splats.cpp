// The splats of a film.
#include <algorithm>
#include <cmath>
#include <utility>

#include "image/film.h"

namespace duet {

namespace {

/// The filter around each pixel of [first, end), integrated over [lower, upper).
std::vector<double> filter_integrals(const FilterProfile& filter, int first, int end, int lower,
                                     int upper) {
  constexpr int kSteps = 1024;
  std::vector<double> integrals;
  for (int i = first; i < end; ++i) {
    const double center = i + 0.5, r = double(filter.radius());
    const double from = std::max(center - r, double(lower)),
                 to = std::min(center + r, double(upper));
    double sum = 0;
    for (int k = 0; k < kSteps; ++k)
      sum += double(filter.weight(float(from + (to - from) * (k + 0.5) / kSteps - center)));
    integrals.push_back(sum * (to - from) / kSteps);
  }
  return integrals;
}

/// Splats by the bands of rows that they count for.
class SplatBands {
 public:
  /// `rows(splat)` are the first and the last row, counted from that of the window; the last is
  /// below the first if the splat counts for none.
  template <class Rows>
  SplatBands(std::span<const Splat> splats, int bands, const Rows& rows) : ends_(size_t(bands)) {
    const auto for_bands = [&](const Splat& s, const auto& f) {
      const auto [first, last] = rows(s);
      if (last < first) return;
      for (int b = first / Film::kTileSize; b <= last / Film::kTileSize; ++b) f(size_t(b));
    };
    for (const Splat& s : splats) for_bands(s, [&](size_t b) { ++ends_[b]; });
    uint32_t total = 0;
    for (uint32_t& end : ends_) total += std::exchange(end, total);
    order_.resize(total);
    for (uint32_t i = 0; i < splats.size(); ++i)
      for_bands(splats[i], [&](size_t b) { order_[ends_[b]++] = i; });
  }
  /// Numbers of the splats.
  std::span<const uint32_t> band(size_t b) const {
    const uint32_t first = b == 0 ? 0 : ends_[b - 1];
    return {order_.data() + first, ends_[b] - first};
  }

 private:
  std::vector<uint32_t> ends_, order_;
};

void add(ExactSum* to, const Spectrum& v, double weight) {
  to[0].add(weight * double(v.r)), to[1].add(weight * double(v.g)), to[2].add(weight * double(v.b));
}

}  // namespace

size_t Film::add_splat_layer(size_t first_channel) {
  if (splats_.empty()) {
    splat_locks_ = std::make_unique<std::mutex[]>(size_t(splat_bands()));
    if (!filter_.is_unit_box()) {
      filter_x_ = filter_integrals(filter_.along_x(), crop().x0, crop().x1, image_.x0, image_.x1);
      filter_y_ = filter_integrals(filter_.along_y(), crop().y0, crop().y1, image_.y0, image_.y1);
    }
  }
  splats_.push_back(
      {first_channel, std::vector<ExactSum>(3 * size_t(crop().width()) * size_t(crop().height()))});
  return splats_.size() - 1;
}

double Film::splat_filter(int x, int y) const {
  return filter_x_.empty() ? 1.0
                           : filter_x_[size_t(x - crop().x0)] * filter_y_[size_t(y - crop().y0)];
}

double Film::splat_mean(size_t layer, int x, int y, int channel) const {
  const double filter = splat_filter(x, y) * passes_;
  const ExactSum& sum = splats_[layer].sums[3 * window_pixel(x, y) + size_t(channel)];
  return filter > 0 ? sum.value() / filter : 0.0;
}

void Film::add_splat_means(std::span<const Film> films, Rows rows, Image& image) const {
  const double filled = count_filled(films);
  for (size_t k = 0; k < splats_.size(); ++k) {
    float* pixel = &image.data[pixels_of(rows).first * channels_.size() + splats_[k].first_channel];
    for (int y = crop().y0 + rows.first; y < crop().y0 + rows.end; ++y)
      for (int x = crop().x0; x < crop().x1; ++x, pixel += channels_.size())
        for (int c = 0; c < 3; ++c) {
          double sum = 0;
          for (const Film& f : films) sum += f.splat_mean(k, x, y, c);
          if (filled > 0) pixel[c] += float(sum / filled);
        }
  }
}

/// Adds the splats of those numbers, each to the three sums that `sum_of` has for it, or null.
template <class F>
static void add_to_pixels(std::span<const Splat> splats, std::span<const uint32_t> numbers,
                          const F& sum_of, double scale) {
  // Splats lie anywhere: the memory is asked for so many before they are added.
  constexpr size_t kAhead = 8;
  for (size_t i = 0; i < numbers.size(); ++i) {
    if (i + kAhead < numbers.size())
      if (const ExactSum* const later = sum_of(splats[numbers[i + kAhead]])) {
        __builtin_prefetch(later, 1);
        __builtin_prefetch(later + 2, 1);
      }
    const Splat& s = splats[numbers[i]];
    if (ExactSum* const sum = sum_of(s)) add(sum, s.value, scale);
  }
}

void Film::add_splats(size_t layer, std::span<const Splat> splats, float scale) {
  // More at a time would be read from memory, in the order of their bands, and not from caches.
  constexpr size_t kAtATime = 1 << 16;
  for (; splats.size() > kAtATime; splats = splats.subspan(kAtATime))
    add_splats(layer, splats.first(kAtATime), scale);
  std::vector<ExactSum>& sums = splats_[layer].sums;
  const FilterProfile& along_y = filter_.along_y();
  const auto rows = [&](const Splat& s) {
    const float y = s.position.y, reach = along_y.radius();
    int first = int(std::floor(y)), last = first;
    if (!image_.contains(int(std::floor(s.position.x)), first)) return std::pair{0, -1};
    if (!filter_.is_unit_box()) {
      first = int(std::ceil(y - reach - 0.5f));
      last = int(std::floor(y + reach - 0.5f));
    }
    return std::pair{std::max(first - crop().y0, 0), std::min(last, crop().y1 - 1) - crop().y0};
  };
  const int bands = splat_bands();
  const SplatBands by_band(splats, bands, rows);
  // Threads that come at the same time begin at different bands.
  const auto start = size_t(reinterpret_cast<uintptr_t>(splats.data()) >> 12);
  for (size_t i = 0; i < size_t(bands); ++i) {
    const size_t band = (start + i) % size_t(bands);
    const std::span<const uint32_t> numbers = by_band.band(band);
    if (numbers.empty()) continue;
    PixelBounds b = crop();
    b.y0 = crop().y0 + int(band) * kTileSize;
    b.y1 = std::min(b.y0 + kTileSize, crop().y1);
    const std::lock_guard lock(splat_locks_[band]);
    if (filter_.is_unit_box()) {
      const auto sum_of = [&](const Splat& s) -> ExactSum* {
        const int x = int(std::floor(s.position.x)), y = int(std::floor(s.position.y));
        return b.contains(x, y) ? &sums[3 * window_pixel(x, y)] : nullptr;
      };
      add_to_pixels(splats, numbers, sum_of, double(scale));
      continue;
    }
    for (const uint32_t number : numbers) {
      const Splat& s = splats[number];
      for_reached_rows(filter_, s.position, b,
                       [&](int x0, int y, std::span<const float> wx, float wy) {
                         ExactSum* to = &sums[3 * window_pixel(x0, y)];
                         for (const float w : wx) add(to, s.value, double(scale * w * wy)), to += 3;
                       });
    }
  }
}

}  // namespace duet
