// An order of the pixels of an image, in which successive ones lie far apart.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "math/vector.h"

namespace duet {

/// Numbers pixels tile after tile, and within a tile such that successive numbers are far apart: by
/// the digits of their Morton code from the lowest on, which are permuted at random at each node.
/// The order is shifted by a random number of pixels in each tile and wraps around. Source: Ahmed &
/// Wonka, "Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error via Hierarchical
/// Ordering of Pixels", ACM TOG 39(6), 2020, for orders by scrambled Morton codes.
class PixelOrder {
 public:
  /// `film` is the size of the whole image; `key` seeds the shifts. Costs next to nothing if the
  /// size is the same as before.
  void start(Point2i film, uint64_t key);

  uint64_t pixels() const { return uint64_t(width_) * height_; }
  /// That of pixel y · width + x: below the number of pixels, and different for each of them.
  uint64_t number(uint64_t pixel) const;

 private:
  static constexpr uint32_t kTile = 16;  ///< pixels per side

  uint32_t width_ = 0, height_ = 0;
  uint64_t key_ = 0;
  /// The order within tiles that are whole, cut off at the right, at the bottom and at both.
  std::array<std::vector<uint8_t>, 4> orders_;
};

/// Divides the pixels of an image into parts of about the same size, each spread evenly: where
/// there are sixteen, each has one pixel of every square of 4 × 4.
class PixelPhases {
 public:
  static constexpr uint32_t kMost = 16;
  /// So many successive pixels of an order are one of each square of 4 × 4.
  static constexpr uint64_t kRun = 16;

  /// As PixelOrder::start(). Costs nothing if that is what was done before.
  void start(Point2i film, uint64_t key);

  const PixelOrder& order() const { return order_; }
  /// That of sixteen to which a pixel belongs.
  uint32_t phase(uint64_t pixel) const {
    return phases_.empty() ? computed_phase(pixel) : phases_[pixel];
  }

 private:
  /// Of larger images, of which a window may be rendered, there is no list of all phases.
  static constexpr uint64_t kMostListed = uint64_t{1} << 26;

  uint32_t computed_phase(uint64_t pixel) const {
    return uint32_t(order_.number(pixel) / kRun % kMost);
  }

  PixelOrder order_;
  uint64_t key_ = 0;
  Point2i film_{};
  std::vector<uint8_t> phases_;
};

/// One of `count` parts; `count` is a power of two, at most PixelPhases::kMost. None is empty if
/// there are PixelPhases::kRun pixels or more for each of sixteen.
struct PixelPhase {
  const PixelPhases* all;
  uint32_t index, count;

  bool has(uint64_t pixel) const { return all->phase(pixel) * count / PixelPhases::kMost == index; }
  bool is_last() const { return index + 1 == count; }
  /// The how-manieth a pixel of this part is in it.
  uint64_t rank(uint64_t pixel) const {
    const uint64_t n = all->order().number(pixel);
    return n / kRound * run() + n % run();
  }
  uint64_t pixels() const;

 private:
  static constexpr uint64_t kRound = PixelPhases::kRun * PixelPhases::kMost;

  uint64_t run() const { return kRound / count; }
};

}  // namespace duet
