// Rational B-spline surfaces.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "geometry/mesh.h"

namespace duet::pbrt {

/// One of the two parameters of a surface.
struct SplineAxis {
  int count = 0;  ///< of control points
  int order = 0;  ///< one more than the degree
  std::vector<double> knots;
  double begin = 0, end = 0;  ///< the part of the surface that is there
};

/// A surface by control points with weights: x, y and z are already multiplied by the fourth.
struct NurbsSurface {
  SplineAxis u, v;
  std::vector<std::array<double, 4>> points;  ///< u fastest
};

/// What is wrong with it; "" if nothing is.
std::string check_axis(const SplineAxis& axis);
std::string check_nurbs(const NurbsSurface& surface);

/// 30 x 30 points of a surface that has passed check_nurbs(), with normals; the parameters are the
/// texture coordinates. Source: Piegl & Tiller, "The NURBS Book", 1997, sections 2.3 and 4.4.
TriangleMesh make_nurbs(const NurbsSurface& surface);

}  // namespace duet::pbrt
