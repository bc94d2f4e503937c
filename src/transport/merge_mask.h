// Where in an image photons are merged, if not everywhere.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "math/vector.h"

namespace duet {

/// A grid of parts over the whole image, row by row: those that are not zero are merged in.
struct MergeMask {
  static constexpr int kSide = 16;  ///< parts per side

  Point2i film;  ///< size of the whole image
  std::vector<uint8_t> parts;

  bool merges(const Point2f& position) const {
    const auto part = [](float p, int size) {
      return std::clamp(int(p * kSide / float(size)), 0, kSide - 1);
    };
    return parts[size_t(part(position.y, film.y) * kSide + part(position.x, film.x))] != 0;
  }
  /// The same for the pixel y · width + x.
  bool merges_in(uint64_t pixel) const {
    const auto width = uint64_t(film.x);
    return merges({float(pixel % width) + 0.5f, float(pixel / width) + 0.5f});
  }
};

}  // namespace duet
