// Curves become tubes.
#include <algorithm>
#include <array>
#include <cmath>

#include "pbrt/curves.h"
#include "pbrt/shapes.h"

namespace duet::pbrt {

namespace {

using P3 = std::array<double, 3>;

P3 mix(std::initializer_list<std::pair<double, P3>> terms) {
  P3 r{};
  for (const auto& [weight, p] : terms)
    for (size_t i = 0; i < 3; ++i) r[i] += weight * p[i];
  return r;
}

/// The Bézier points of a segment, of degree 3.
std::array<P3, 4> cubic_bezier(const std::vector<P3>& p, size_t first, bool bspline, int degree) {
  const auto at = [&](size_t i) { return p[first + i]; };
  if (degree == 3 && !bspline) return {at(0), at(1), at(2), at(3)};
  if (degree == 3)
    return {mix({{1.0 / 6, at(0)}, {4.0 / 6, at(1)}, {1.0 / 6, at(2)}}),
            mix({{2.0 / 3, at(1)}, {1.0 / 3, at(2)}}), mix({{1.0 / 3, at(1)}, {2.0 / 3, at(2)}}),
            mix({{1.0 / 6, at(1)}, {4.0 / 6, at(2)}, {1.0 / 6, at(3)}})};
  const std::array<P3, 3> q = bspline ? std::array<P3, 3>{mix({{0.5, at(0)}, {0.5, at(1)}}), at(1),
                                                          mix({{0.5, at(1)}, {0.5, at(2)}})}
                                      : std::array<P3, 3>{at(0), at(1), at(2)};
  return {q[0], mix({{1.0 / 3, q[0]}, {2.0 / 3, q[1]}}), mix({{2.0 / 3, q[1]}, {1.0 / 3, q[2]}}),
          q[2]};
}

}  // namespace

std::string check_curve(const CurvePoints& c) {
  const size_t n = c.points.size(), degree = size_t(c.degree);
  if (c.degree != 2 && c.degree != 3)
    return fmt::format("a curve's degree is 2 or 3, not {}", c.degree);
  if (c.bspline ? n < degree + 1 : n < degree + 1 || (n - 1) % degree != 0)
    return fmt::format("{} points do not make a curve of degree {}", n, c.degree);
  return {};
}

CurveSet make_tubes(const CurvePoints& c) {
  CurveSet set;
  set.kind = CurveKind::bspline;
  const size_t degree = size_t(c.degree);
  const size_t segments = c.bspline ? c.points.size() - degree : (c.points.size() - 1) / degree;
  for (size_t s = 0; s < segments; ++s) {
    const auto b = cubic_bezier(c.points, c.bspline ? s : s * degree, c.bspline, c.degree);
    // The uniform B-spline that is the same polynomial between its inner points.
    const std::array<P3, 4> spline{mix({{6, b[0]}, {-7, b[1]}, {2, b[2]}}),
                                   mix({{2, b[1]}, {-1, b[2]}}), mix({{-1, b[1]}, {2, b[2]}}),
                                   mix({{2, b[1]}, {-7, b[2]}, {6, b[3]}})};
    set.segments.push_back(uint32_t(set.points.size()));
    for (size_t i = 0; i < 4; ++i) {
      // Linear along the whole curve; such control points make it so.
      const double u = (double(s) + double(i) - 1) / double(segments);
      const double width = c.width0 + u * (c.width1 - c.width0);
      set.points.push_back(
          {{float(spline[i][0]), float(spline[i][1]), float(spline[i][2])}, float(0.5 * width)});
    }
  }
  return set;
}

}  // namespace duet::pbrt
