#include "image/film.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/parallel.h"

namespace duet {

namespace {

/// Calls `f(x0, y, wx, wy)` for each row of `bounds` that a sample at `p` counts for: its pixels
/// from x0 on have the weights wx[i] wy.
template <class F>
void for_reached_rows(const ReconstructionFilter& filter, const Point2f& p,
                      const PixelBounds& bounds, F&& f) {
  constexpr int kMaxReach = 64;
  const FilterProfile &along_x = filter.along_x(), &along_y = filter.along_y();
  const float rx = along_x.radius(), ry = along_y.radius();
  // Pixel i has its centre at i + 1/2.
  const int x0 = std::max(bounds.x0, int(std::ceil(p.x - rx - 0.5f)));
  const int x1 = std::min(bounds.x1 - 1, int(std::floor(p.x + rx - 0.5f)));
  const int y0 = std::max(bounds.y0, int(std::ceil(p.y - ry - 0.5f)));
  const int y1 = std::min(bounds.y1 - 1, int(std::floor(p.y + ry - 0.5f)));
  if (x0 > x1 || y0 > y1) return;
  assert(x1 - x0 < kMaxReach);
  float wx[kMaxReach];
  for (int x = x0; x <= x1; ++x) wx[x - x0] = along_x.weight(float(x) + 0.5f - p.x);
  for (int y = y0; y <= y1; ++y)
    f(x0, y, std::span<const float>(wx, size_t(x1 - x0 + 1)),
      along_y.weight(float(y) + 0.5f - p.y));
}

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

/// By what to multiply the sums of this many samples to make them sums of `wanted` ones: exactly
/// one if all have the same number.
double sample_scale(double wanted, uint64_t samples) {
  return samples > 0 ? wanted / double(samples) : 1.0;
}

/// Where there is light: all of the image, or the window.
PixelBounds lit_part(const FilmLayout& layout) {
  return layout.ends_at_crop ? layout.crop : PixelBounds{0, 0, layout.full.x, layout.full.y};
}

/// Calls `f(sampled, stored)` for the tiles of a film, row by row.
template <class F>
void for_tiles(const FilmLayout& layout, int border, F&& f) {
  constexpr int kSize = Film::kTileSize;
  const PixelBounds sampled = layout.crop.grow(border).intersect(lit_part(layout));
  for (int ty = sampled.y0 / kSize; ty * kSize < sampled.y1; ++ty)
    for (int tx = sampled.x0 / kSize; tx * kSize < sampled.x1; ++tx) {
      const PixelBounds square{tx * kSize, ty * kSize, (tx + 1) * kSize, (ty + 1) * kSize};
      const PixelBounds inside = square.intersect(sampled);
      const PixelBounds stored = inside.grow(border).intersect(layout.crop);
      if (!stored.empty()) f(inside, stored);
    }
}

}  // namespace

PixelBounds PixelBounds::intersect(const PixelBounds& o) const {
  return {std::max(x0, o.x0), std::max(y0, o.y0), std::min(x1, o.x1), std::min(y1, o.y1)};
}

float SampleLimit::share(const float* rgb) const {
  double largest = 0;
  for (const auto& row : sensor)
    largest = std::max(largest,
                       row[0] * double(rgb[0]) + row[1] * double(rgb[1]) + row[2] * double(rgb[2]));
  return largest > most ? float(most / largest) : 1.0f;
}

FilmTile::FilmTile(const PixelBounds& sampled, const PixelBounds& stored, int channels,
                   const std::optional<SampleLimit>& limit)
    : sampled_(sampled),
      stored_(stored),
      channels_(channels),
      limit_(limit),
      data_(size_t(stored.width()) * stored.height() * (channels + 1)) {}

void FilmTile::add_to_pixel(int x, int y, std::span<const float> values) {
  if (!stored_.contains(x, y)) return;
  double* s = sums(x, y);
  *s++ += 1;
  if (limit_) {
    const float share = limit_->share(values.data());
    for (size_t c = 0; c < 3; ++c) *s++ += double(share * values[c]);
    values = values.subspan(3);
  }
  for (const float v : values) *s++ += double(v);
}

void FilmTile::add_sample(const ReconstructionFilter& filter, const Point2f& p,
                          std::span<const float> values) {
  const size_t limited = limit_ ? 3 : 0;
  const float share = limit_ ? limit_->share(values.data()) : 1.0f;
  for_reached_rows(filter, p, stored_, [&](int x0, int y, std::span<const float> wx, float wy) {
    double* s = sums(x0, y);
    for (const float w0 : wx) {
      const float w = w0 * wy;
      *s++ += w;
      for (size_t c = 0; c < limited; ++c) *s++ += double(w) * (share * values[c]);
      for (size_t c = limited; c < values.size(); ++c) *s++ += double(w) * values[c];
    }
  });
}

Film::Film(const FilmLayout& layout, std::vector<std::string> channels)
    : full_(layout.full),
      crop_(layout.crop),
      image_(lit_part(layout)),
      filter_(layout.filter),
      response_(layout.response),
      channels_(std::move(channels)) {
  const bool colored = channels_.size() >= 3 && channels_[0] == "R";
  const std::optional<SampleLimit> limit = colored ? layout.sample_limit : std::nullopt;
  for_tiles(layout, filter_.border(), [&](const PixelBounds& sampled, const PixelBounds& stored) {
    tiles_.emplace_back(sampled, stored, int(channels_.size()), limit);
  });
}

double Film::tile_bytes(const FilmLayout& layout, size_t channels) {
  // What an allocation takes besides.
  constexpr double kHead = 16;
  double bytes = 0;
  for_tiles(layout, ReconstructionFilter(layout.filter).border(),
            [&](const PixelBounds&, const PixelBounds& stored) {
              bytes += sizeof(FilmTile) + kHead +
                       double(stored.width()) * stored.height() *
                           double((channels + 1) * sizeof(double));
            });
  return bytes;
}

double Film::layer_bytes() const {
  size_t sums = colour_sums_.size() + squares_.size();
  for (const SplatLayer& layer : splats_) sums += layer.sums.size();
  return double(sums * sizeof(double));
}

Image Film::develop() const {
  const int n = int(channels_.size());
  Image image(crop_.width(), crop_.height(), channels_);
  std::vector<double> sums(size_t(crop_.width()) * crop_.height() * (n + 1));
  uint64_t most = 0;
  for (const FilmTile& tile : tiles_) most = std::max(most, tile.samples_);
  for (const FilmTile& tile : tiles_) {
    const double scale = sample_scale(double(most), tile.samples_);
    const PixelBounds& b = tile.stored_;
    const double* from = tile.data_.data();
    for (int y = b.y0; y < b.y1; ++y) {
      double* to = &sums[(size_t(y - crop_.y0) * crop_.width() + (b.x0 - crop_.x0)) * (n + 1)];
      for (int i = 0; i < b.width() * (n + 1); ++i) *to++ += scale * *from++;
    }
  }
  float* out = image.data.data();
  for (size_t i = 0; i < sums.size(); i += n + 1) {
    const double w = sums[i];
    for (int c = 1; c <= n; ++c) *out++ = w != 0 ? float(sums[i + c] / w) : 0.0f;
  }
  for (size_t k = 0; k < splats_.size(); ++k) {
    float* pixel = image.data.data() + splats_[k].first_channel;
    for (int y = crop_.y0; y < crop_.y1; ++y)
      for (int x = crop_.x0; x < crop_.x1; ++x, pixel += n)
        for (int c = 0; c < 3; ++c) pixel[c] += float(splat_mean(k, x, y, c));
  }
  respond(image);
  for (const size_t first : moment_channels_)
    for (size_t i = 0; i < squares_.size(); ++i)
      image.data[i / 3 * size_t(n) + first + i % 3] = float(squares_[i] / std::max(1, passes_));
  return image;
}

void Film::respond(Image& image) const {
  const size_t n = channels_.size();
  if (!response_ || n < 3 || channels_[0] != "R") return;
  for (size_t i = 0; i < image.data.size(); i += n) {
    const std::array<float, 3> from{image.data[i], image.data[i + 1], image.data[i + 2]};
    for (size_t c = 0; c < 3; ++c) {
      const auto& row = (*response_)[c];
      image.data[i + c] =
          float(row[0] * double(from[0]) + row[1] * double(from[1]) + row[2] * double(from[2]));
    }
  }
}

void Film::add_moments(size_t first_channel) {
  moment_channels_.push_back(first_channel);
  colour_sums_.resize(3 * size_t(crop_.width()) * size_t(crop_.height()));
  squares_.resize(colour_sums_.size());
}

void Film::end_pass() {
  ++passes_;
  if (moment_channels_.empty()) return;
  const Image now = develop();
  for (size_t i = 0; i < squares_.size(); ++i) {
    const double sum = double(now.data[i / 3 * channels_.size() + i % 3]) * passes_;
    const double added = sum - colour_sums_[i];
    squares_[i] += added * added;
    colour_sums_[i] = sum;
  }
}

size_t Film::add_splat_layer(size_t first_channel) {
  if (splats_.empty() && !filter_.is_unit_box()) {
    filter_x_ = filter_integrals(filter_.along_x(), crop_.x0, crop_.x1, image_.x0, image_.x1);
    filter_y_ = filter_integrals(filter_.along_y(), crop_.y0, crop_.y1, image_.y0, image_.y1);
  }
  splats_.push_back(
      {first_channel, std::vector<double>(3 * size_t(crop_.width()) * size_t(crop_.height()))});
  return splats_.size() - 1;
}

double Film::splat_mean(size_t layer, int x, int y, int channel) const {
  if (passes_ == 0) return 0;
  const size_t column = size_t(x - crop_.x0), row = size_t(y - crop_.y0);
  const double sum =
      splats_[layer].sums[3 * (row * size_t(crop_.width()) + column) + size_t(channel)];
  const double filter = filter_x_.empty() ? 1.0 : filter_x_[column] * filter_y_[row];
  return filter > 0 ? sum / (filter * passes_) : 0.0;
}

void Film::add_splats(size_t layer, std::span<const Splat> splats, float scale, int threads) {
  std::vector<double>& sums = splats_[layer].sums;
  const auto add = [&](double* to, const Spectrum& v, double weight) {
    to[0] += weight * double(v.r), to[1] += weight * double(v.g), to[2] += weight * double(v.b);
  };
  const auto row = [&](int x, int y) {
    return &sums[3 * (size_t(y - crop_.y0) * size_t(crop_.width()) + size_t(x - crop_.x0))];
  };
  // Each thread has rows of its own and goes through all splats, in their order.
  const int bands = std::min(std::max(1, threads), crop_.height());
  parallel_for(size_t(bands), threads, [&](size_t band) {
    PixelBounds b = crop_;
    b.y0 = crop_.y0 + int(band) * crop_.height() / bands;
    b.y1 = crop_.y0 + int(band + 1) * crop_.height() / bands;
    for (const Splat& s : splats) {
      if (filter_.is_unit_box()) {
        const int x = int(std::floor(s.position.x)), y = int(std::floor(s.position.y));
        if (b.contains(x, y)) add(row(x, y), s.value, double(scale));
        continue;
      }
      if (!image_.contains(int(std::floor(s.position.x)), int(std::floor(s.position.y)))) continue;
      for_reached_rows(filter_, s.position, b,
                       [&](int x0, int y, std::span<const float> wx, float wy) {
                         double* to = row(x0, y);
                         for (const float w : wx) add(to, s.value, double(scale * w * wy)), to += 3;
                       });
    }
  });
}

Film Film::mean(std::span<const Film> films) {
  Film mean = films[0];
  // `part` becomes the sum of that of all films, each scaled as if it had the mean number of
  // samples of those that have any. The sum then stands for the sum of these numbers.
  const auto add_up = [&](const auto& samples, const auto& part) {
    double total = 0, filled = 0;
    for (const Film& f : films) total += double(samples(f)), filled += samples(f) > 0;
    std::vector<double>& to = part(mean);
    std::fill(to.begin(), to.end(), 0.0);
    for (const Film& f : films) {
      if (samples(f) == 0) continue;
      const double scale = sample_scale(total / filled, samples(f));
      const std::vector<double>& from = part(f);
      for (size_t i = 0; i < to.size(); ++i) to[i] += scale * from[i];
    }
    return total;
  };
  for (size_t k = 0; k < mean.tiles_.size(); ++k)
    mean.tiles_[k].samples_ = uint64_t(add_up([&](const Film& f) { return f.tiles_[k].samples_; },
                                              [&](auto& f) -> auto& { return f.tiles_[k].data_; }));
  const auto passes = [](const Film& f) { return uint64_t(f.passes_); };
  for (size_t k = 0; k < mean.splats_.size(); ++k)
    add_up(
        passes, [&](auto& f) -> auto& { return f.splats_[k].sums; });
  add_up(
      passes, [](auto& f) -> auto& { return f.squares_; });
  mean.passes_ = 0;
  for (const Film& f : films) mean.passes_ += f.passes_;
  return mean;
}

}  // namespace duet
