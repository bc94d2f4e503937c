// Curves of pbrt as tubes.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "geometry/curves.h"

namespace duet::pbrt {

struct CurvePoints {
  std::vector<std::array<double, 3>> points;
  bool bspline = false;  ///< else Bézier
  int degree = 3;        ///< 2 or 3
  double width0 = 1, width1 = 1;
};

/// What is wrong with the number of points; empty if nothing is.
std::string check_curve(const CurvePoints& curve);
/// Tubes as wide as the curve, which passes check_curve().
CurveSet make_tubes(const CurvePoints& curve);

}  // namespace duet::pbrt
