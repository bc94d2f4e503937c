// Which layer of the image belongs to which technique.
#pragma once

#include <array>
#include <cstddef>

namespace duet {

/// First channels of the layers of techniques; 0 where there is none.
struct TechniqueLayers {
  /// Longer paths have too many techniques for an image each.
  static constexpr int kMaxDepth = 12;
  static constexpr size_t kSize = kMaxDepth + 2;

  bool enabled = false;
  std::array<std::array<size_t, kSize>, kSize> connections{}, merges{};  ///< by s and t

  size_t connection(int s, int t) const { return enabled ? connections[size_t(s)][size_t(t)] : 0; }
  size_t merge(int s, int t) const { return enabled ? merges[size_t(s)][size_t(t)] : 0; }
};

}  // namespace duet
