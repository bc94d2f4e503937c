// Which light sub-paths a pixel is connected with.
#pragma once

#include "math/pixel_order.h"

namespace duet {

/// Gives each pixel of an image one of an iteration's light sub-paths. Pixels that share a sub-path
/// have a part of their error in common. So they lie apart, in all directions alike, but within a
/// tile of 16 × 16 pixels as far as possible, whose sub-paths then stay in the cache. The order is
/// the same in all iterations, as the sub-path of one number is a low-discrepancy sequence over
/// them.
///
/// The vertices of an eye sub-path are connected with different sub-paths of a tile: a light
/// sub-path that has carried nothing to where it is needed is bad luck for one of them alone.
class SubpathSharing {
 public:
  /// `film` is the size of the whole image; `key` seeds the order. If there is a `phase`, the
  /// sub-paths are those of its pixels; it must outlive the calls of subpath().
  void start(Point2i film, uint64_t key, const PixelPhase* phase = nullptr) {
    order_.start(film, key);
    phase_ = phase;
    tile_ = phase ? kTile / phase->count : kTile;
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

  /// Sub-paths [first, first + count), in the order of their numbers those of about a tile or,
  /// where none is shared, of a row of it.
  struct Group {
    size_t first, count;
  };
  Group group(size_t subpath, size_t subpaths) const {
    const uint64_t pixels = phase_ ? phase_->pixels() : order_.pixels();
    const uint64_t together = phase_ || subpaths < pixels ? tile_ : kRow;
    const size_t most = std::max<size_t>(1, size_t(together * subpaths / pixels));
    const size_t first = subpath / most * most;
    return {first, std::min(most, subpaths - first)};
  }
  /// The sub-path that the vertex `depth` segments from the camera is connected with, where
  /// subpath() is that of the pixel and of its first vertex.
  size_t at_vertex(size_t subpath, size_t subpaths, int depth) const {
    const Group g = group(subpath, subpaths);
    return g.first + (subpath - g.first + size_t(depth - 1)) % g.count;
  }

 private:
  static constexpr uint64_t kTile = 256, kRow = 16;  ///< pixels

  PixelOrder order_;
  const PixelPhase* phase_ = nullptr;
  uint64_t tile_ = kTile;  ///< pixels of a tile, of the phase if there is one
};

}  // namespace duet
