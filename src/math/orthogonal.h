// Unit vectors orthogonal to another one, in double precision.
#pragma once

#include <array>

namespace duet {

/// Orthogonal to the unit vector `d`; steady but for where d.z changes its sign.
/// Source: Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
std::array<double, 3> duff_orthogonal(const std::array<double, 3>& d);

/// Orthogonal to the unit vector `d` and to the vector that is orthogonal to it in the plane of a
/// coordinate axis: that of x and z, or of y and z, in which `d` is longer.
std::array<double, 3> axis_orthogonal(const std::array<double, 3>& d);

}  // namespace duet
