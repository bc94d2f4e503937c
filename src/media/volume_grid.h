// Numbers on a regular grid in space: what volume files yield.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace duet {

/// Values at the nodes of a grid, x fastest, then y, then z; the channels of a node are neighbours.
struct VolumeGrid {
  std::array<int, 3> size{1, 1, 1};  ///< number of nodes along x, y and z
  int channels = 1;  ///< 1 (a number), 3 (a colour or a vector) or 6 (a symmetric matrix)
  /// The box that the file says the grid fills.
  std::array<float, 3> lower{0, 0, 0}, upper{1, 1, 1};
  std::vector<float> values;
  bool operator==(const VolumeGrid&) const = default;

  size_t node_count() const { return size_t(size[0]) * size_t(size[1]) * size_t(size[2]); }
};

/// How a value between nodes is found.
enum class VolumeFilter : unsigned char { trilinear, nearest };
/// Which node stands for one beyond the border.
enum class VolumeWrap : unsigned char { clamp, repeat, mirror };
/// Where the outermost nodes lie in the unit cube that a grid fills.
enum class VolumeNodes : unsigned char {
  within,    ///< half a cell inside (Mitsuba 3); the wrap mode says what comes beyond
  on_faces,  ///< on the cube's faces (Mitsuba 0.x, OpenVDB); everything outside of it is zero
  beyond,    ///< half a cell outside (pbrt); everything outside of the cube is zero
};

}  // namespace duet
