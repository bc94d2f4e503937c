// Light vertices drawn from those of all sub-paths of an iteration, for connections with a fixed
// number of them (a light vertex cache, docs/mis.md).
#pragma once

#include <cstdint>

#include "math/hash.h"

namespace duet {

/// Draws `count` vertices for each eye vertex, one of each of as many parts of the cache, every
/// vertex with the same probability.
class DrawnVertices {
 public:
  DrawnVertices() = default;
  DrawnVertices(size_t vertices, size_t subpaths, int count)
      : count_(vertices > 0 ? count : 0),
        part_(double(vertices) / count),
        last_(uint32_t(vertices) - 1),
        scale_(float(part_ / double(subpaths))) {}

  int count() const { return count_; }
  /// What the connection with a drawn vertex is to be multiplied by.
  float scale() const { return scale_; }
  /// The index of number `i` below count() of those for the vertex `depth` of the eye sub-path that
  /// `key` belongs to.
  uint32_t draw(uint64_t key, int depth, int i) const {
    const uint64_t bits = mix64(key ^ (uint64_t(uint32_t(depth)) << 32 | uint32_t(i))) >> 32;
    const auto index = uint32_t((double(i) + double(bits) * 0x1p-32) * part_);
    return index < last_ ? index : last_;
  }

 private:
  int count_ = 0;
  double part_ = 0;  ///< vertices of each part
  uint32_t last_ = 0;
  float scale_ = 0;
};

}  // namespace duet
