#include "image/film_tile.h"

#include <algorithm>

namespace duet {

PixelBounds PixelBounds::intersect(const PixelBounds& o) const {
  return {std::max(x0, o.x0), std::max(y0, o.y0), std::min(x1, o.x1), std::min(y1, o.y1)};
}

FilmTile::FilmTile(const PixelBounds& sampled, const PixelBounds& stored, size_t channels)
    : sampled_(sampled),
      stored_(stored),
      stride_(channels + 1),
      sums_(size_t(stored.width()) * size_t(stored.height()) * stride_) {}

void FilmTile::add(const FilmTile& o) {
  samples_ += o.samples_;
  const PixelBounds& b = o.stored_;
  for (int y = b.y0; y < b.y1; ++y) {
    const ExactSum* from = &o.sums_[o.index(b.x0, y)];
    ExactSum* to = &sums_[index(b.x0, y)];
    for (size_t i = 0; i < size_t(b.width()) * stride_; ++i) to[i].add(from[i]);
  }
}

void FilmTile::clear() {
  samples_ = 0;
  std::fill(sums_.begin(), sums_.end(), ExactSum());
}

}  // namespace duet
