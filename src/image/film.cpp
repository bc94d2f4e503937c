#include "image/film.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace duet {

PixelBounds PixelBounds::intersect(const PixelBounds& o) const {
  return {std::max(x0, o.x0), std::max(y0, o.y0), std::min(x1, o.x1), std::min(y1, o.y1)};
}

FilmTile::FilmTile(const PixelBounds& sampled, const PixelBounds& stored, int channels)
    : sampled_(sampled),
      stored_(stored),
      channels_(channels),
      data_(size_t(stored.width()) * stored.height() * (channels + 1)) {}

void FilmTile::add_to_pixel(int x, int y, std::span<const float> values, float count) {
  if (!stored_.contains(x, y)) return;
  double* s = sums(x, y);
  s[0] += count;
  for (size_t c = 0; c < values.size(); ++c) s[c + 1] += values[c];
}

void FilmTile::add_sample(const ReconstructionFilter& filter, const Point2f& p,
                          std::span<const float> values) {
  constexpr int kMaxReach = 64;
  const float r = filter.radius();
  // Pixel i has its centre at i + 1/2.
  const int x0 = std::max(stored_.x0, int(std::ceil(p.x - r - 0.5f)));
  const int x1 = std::min(stored_.x1 - 1, int(std::floor(p.x + r - 0.5f)));
  const int y0 = std::max(stored_.y0, int(std::ceil(p.y - r - 0.5f)));
  const int y1 = std::min(stored_.y1 - 1, int(std::floor(p.y + r - 0.5f)));
  if (x0 > x1 || y0 > y1) return;
  assert(x1 - x0 < kMaxReach);
  float wx[kMaxReach];
  for (int x = x0; x <= x1; ++x) wx[x - x0] = filter.weight(float(x) + 0.5f - p.x);
  for (int y = y0; y <= y1; ++y) {
    const float wy = filter.weight(float(y) + 0.5f - p.y);
    double* s = sums(x0, y);
    for (int x = x0; x <= x1; ++x) {
      const float w = wx[x - x0] * wy;
      *s++ += w;
      for (const float v : values) *s++ += double(w) * v;
    }
  }
}

void FilmTile::add(const FilmTile& other) {
  for (size_t i = 0; i < data_.size(); ++i) data_[i] += other.data_[i];
}

Film::Film(const FilmLayout& layout, std::vector<std::string> channels)
    : full_(layout.full),
      crop_(layout.crop),
      filter_(layout.filter),
      channels_(std::move(channels)) {
  const PixelBounds image{0, 0, full_.x, full_.y};
  const PixelBounds sampled = crop_.grow(filter_.border()).intersect(image);
  const int n = int(channels_.size());
  for (int ty = sampled.y0 / kTileSize; ty * kTileSize < sampled.y1; ++ty)
    for (int tx = sampled.x0 / kTileSize; tx * kTileSize < sampled.x1; ++tx) {
      const PixelBounds square{tx * kTileSize, ty * kTileSize, (tx + 1) * kTileSize,
                               (ty + 1) * kTileSize};
      const PixelBounds inside = square.intersect(sampled);
      const PixelBounds stored = inside.grow(filter_.border()).intersect(crop_);
      if (!stored.empty()) tiles_.emplace_back(inside, stored, n);
    }
}

Image Film::develop() const {
  const int n = int(channels_.size());
  Image image(crop_.width(), crop_.height(), channels_);
  std::vector<double> sums(size_t(crop_.width()) * crop_.height() * (n + 1));
  for (const FilmTile& tile : tiles_) {
    const PixelBounds& b = tile.stored_;
    const double* from = tile.data_.data();
    for (int y = b.y0; y < b.y1; ++y) {
      double* to = &sums[(size_t(y - crop_.y0) * crop_.width() + (b.x0 - crop_.x0)) * (n + 1)];
      for (int i = 0; i < b.width() * (n + 1); ++i) *to++ += *from++;
    }
  }
  float* out = image.data.data();
  for (size_t i = 0; i < sums.size(); i += n + 1) {
    const double w = sums[i];
    for (int c = 1; c <= n; ++c) *out++ = w != 0 ? float(sums[i + c] / w) : 0.0f;
  }
  return image;
}

void Film::add(const Film& other) {
  assert(tiles_.size() == other.tiles_.size());
  for (size_t i = 0; i < tiles_.size(); ++i) tiles_[i].add(other.tiles_[i]);
}

}  // namespace duet
