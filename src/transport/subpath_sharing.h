// Which light sub-path a pixel is connected with, where there are not as many sub-paths as pixels.
#pragma once

#include "math/pixel_order.h"

namespace duet {

/// Gives each pixel of an image one of an iteration's light sub-paths. Pixels that share a sub-path
/// have a part of their error in common. So they lie apart, in all directions alike, but within a
/// tile of 16 × 16 pixels as far as possible, whose sub-paths then stay in the cache. The order is
/// the same in all iterations, as the sub-path of one number is a low-discrepancy sequence over
/// them.
class SubpathSharing {
 public:
  /// `film` is the size of the whole image; `key` seeds the order. If there is a `phase`, the
  /// sub-paths are those of its pixels; it must outlive the calls of subpath().
  void start(Point2i film, uint64_t key, const PixelPhase* phase = nullptr) {
    order_.start(film, key);
    phase_ = phase;
  }

  /// The sub-path of pixel y · width + x, below `subpaths`. Each sub-path has as many pixels as any
  /// other, give or take one. If there is one for every pixel none is shared, and neighbours have
  /// neighbours.
  size_t subpath(uint64_t pixel, size_t subpaths) const {
    const uint64_t pixels = order_.pixels();
    // That of a pixel of another phase is not asked for, but has to be one.
    if (phase_)
      return std::min(size_t(phase_->rank(pixel) * subpaths / phase_->pixels()), subpaths - 1);
    return size_t((subpaths < pixels ? order_.number(pixel) : pixel) * subpaths / pixels);
  }

 private:
  PixelOrder order_;
  const PixelPhase* phase_ = nullptr;
};

}  // namespace duet
