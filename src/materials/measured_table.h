// Measurements of how a material reflects light, as its file has them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace duet {

/// An isotropic or anisotropic reflectance in the adaptive parametrisation of Dupuy & Jakob, "An
/// Adaptive Parameterization for Efficient Material Acquisition and Rendering", 2018. Grids are
/// nodes over the unit square, x fastest.
struct MeasuredTable {
  struct Grid {
    std::array<uint32_t, 2> size{0, 0};  ///< nodes along x and y, each at least 2
    std::vector<float> values;           ///< one or more grids of that size
    size_t nodes() const { return size_t(size[0]) * size[1]; }
    bool operator==(const Grid&) const = default;
  };
  /// Angles of the incident direction at which there are measurements, increasing.
  std::vector<float> phi, theta;
  Grid ndf, sigma;           ///< distribution of normals, and projected area
  Grid vndf, luminance;      ///< per phi and theta, theta fastest
  Grid rgb;                  ///< per phi, theta and channel, the channel fastest
  bool has_jacobian = true;  ///< reflectances were divided by what the normals reflect
  bool operator==(const MeasuredTable&) const = default;
};

}  // namespace duet
