// Which light sub-path a pixel is connected with, where there are not as many sub-paths as pixels.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "math/vector.h"

namespace duet {

/// Gives each pixel of an image one of an iteration's light sub-paths. Pixels that share a sub-path
/// have a part of their error in common. So they lie apart, in all directions alike, but within a
/// tile of 16 × 16 pixels as far as possible, whose sub-paths then stay in the cache.
///
/// Pixels are numbered tile after tile, and within a tile such that successive numbers are far
/// apart: by the digits of their Morton code from the lowest on, which are permuted at random at
/// each node. The order is shifted by a random number of pixels in each tile and wraps around. It
/// is the same in all iterations, as the sub-path of one number is a low-discrepancy sequence over
/// them. Source: Ahmed & Wonka, "Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error
/// via Hierarchical Ordering of Pixels", ACM TOG 39(6), 2020, for orders by scrambled Morton codes.
class SubpathSharing {
 public:
  /// `film` is the size of the whole image; `key` seeds the shifts. Costs next to nothing if the
  /// size is the same as before.
  void start(Point2i film, uint64_t key);

  /// The sub-path of pixel y · width + x, below `subpaths`. Each sub-path has as many pixels as any
  /// other, give or take one. If there is one for every pixel none is shared, and neighbours have
  /// neighbours.
  size_t subpath(uint64_t pixel, size_t subpaths) const {
    const uint64_t pixels = uint64_t(width_) * height_;
    return size_t((subpaths < pixels ? number(pixel) : pixel) * subpaths / pixels);
  }

 private:
  static constexpr uint32_t kTile = 16;  ///< pixels per side
  /// Below the number of pixels, and different for each of them.
  uint64_t number(uint64_t pixel) const;

  uint32_t width_ = 0, height_ = 0;
  uint64_t key_ = 0;
  /// The order within tiles that are whole, cut off at the right, at the bottom and at both.
  std::array<std::vector<uint8_t>, 4> orders_;
};

}  // namespace duet
