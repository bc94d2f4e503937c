#include "math/pixel_order.h"

#include <algorithm>
#include <numeric>

#include "math/hash.h"

namespace duet {

namespace {

constexpr int kBits = 4;  ///< of a coordinate within a tile

/// The permuted digits of the Morton code of a place, the lowest first in weight: the quarter of
/// the tile that the place lies in counts least.
uint32_t spread_code(uint32_t x, uint32_t y) {
  uint32_t node = 1, code = 0;
  for (int bit = kBits - 1; bit >= 0; --bit) {
    const uint32_t quarter = ((y >> bit) & 1) << 1 | ((x >> bit) & 1);
    code |= (quarter ^ (mix32(node) & 3)) << 2 * (kBits - 1 - bit);
    node = node << 2 | quarter;
  }
  return code;
}

std::vector<uint8_t> spread_order(uint32_t width, uint32_t height) {
  std::vector<uint32_t> places(width * height);
  std::iota(places.begin(), places.end(), 0u);
  std::sort(places.begin(), places.end(), [&](uint32_t a, uint32_t b) {
    return spread_code(a % width, a / width) < spread_code(b % width, b / width);
  });
  std::vector<uint8_t> order(places.size());
  for (size_t i = 0; i < places.size(); ++i) order[places[i]] = uint8_t(i);
  return order;
}

}  // namespace

void PixelOrder::start(Point2i film, uint64_t key) {
  key_ = key;
  if (width_ == uint32_t(film.x) && height_ == uint32_t(film.y)) return;
  width_ = uint32_t(film.x), height_ = uint32_t(film.y);
  const uint32_t right = width_ % kTile, bottom = height_ % kTile;
  orders_ = {spread_order(kTile, kTile), spread_order(right, kTile), spread_order(kTile, bottom),
             spread_order(right, bottom)};
}

uint64_t PixelOrder::number(uint64_t pixel) const {
  const uint32_t y = uint32_t(pixel / width_), x = uint32_t(pixel % width_);
  const uint32_t x0 = x / kTile * kTile, y0 = y / kTile * kTile;
  const uint32_t w = std::min(kTile, width_ - x0), h = std::min(kTile, height_ - y0);
  const uint64_t random = hash_combine(key_, (uint64_t(y0) << 32) + x0);
  const uint32_t shifted_x = (x - x0 + uint32_t(random & 0xffff)) % w,
                 shifted_y = (y - y0 + uint32_t(random >> 32 & 0xffff)) % h;
  const std::vector<uint8_t>& order = orders_[size_t(w < kTile) + 2 * size_t(h < kTile)];
  return uint64_t(y0) * width_ + uint64_t(x0) * h + order[size_t(shifted_y) * w + shifted_x];
}

void PixelPhases::start(Point2i film, uint64_t key) {
  if (film.x == film_.x && film.y == film_.y && key == key_) return;
  film_ = film, key_ = key;
  order_.start(film, key);
  const uint64_t pixels = order_.pixels();
  phases_.resize(pixels <= kMostListed ? pixels : 0);
  for (uint64_t pixel = 0; pixel < phases_.size(); ++pixel)
    phases_[pixel] = uint8_t(computed_phase(pixel));
}

uint64_t PixelPhase::pixels() const {
  const uint64_t all_pixels = all->order().pixels(), whole = all_pixels / kRound * run();
  const int64_t left = int64_t(all_pixels % kRound) - int64_t(run() * index);
  return whole + uint64_t(std::clamp(left, int64_t{0}, int64_t(run())));
}

}  // namespace duet
