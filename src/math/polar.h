// The rotation in a linear map, apart from what it stretches.
#pragma once

#include "math/transform.h"

namespace duet {

/// The linear part of a map as M = rotation · stretch: a proper rotation after a symmetric map,
/// which is negative definite if M mirrors. Both with no translation.
struct PolarParts {
  Matrix4 rotation, stretch;
};

/// The polar decomposition of the upper left 3×3 block, which must not be singular. Source: Higham,
/// "Computing the Polar Decomposition — with Applications", SIAM J. Sci. Stat. Comput. 7(4), 1986.
PolarParts polar_parts(const Matrix4& m);

}  // namespace duet
