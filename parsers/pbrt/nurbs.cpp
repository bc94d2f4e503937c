#include "pbrt/nurbs.h"

#include <algorithm>
#include <cmath>

#include "pbrt/shapes.h"

namespace duet::pbrt {

namespace {

using P4 = std::array<double, 4>;

constexpr int kPoints = 30;
constexpr int kHighestOrder = 64;

/// The basis functions that are not zero at t, from the control point `first` on, and their
/// derivatives.
struct Basis {
  size_t first;
  std::vector<double> value, slope;
};

Basis basis_at(const SplineAxis& a, double t) {
  const size_t order = size_t(a.order), count = size_t(a.count);
  const auto& knots = a.knots;
  // The last span of the knots that begins at or before t, and has control points.
  size_t span = order - 1;
  while (span + 1 < count && knots[span + 1] <= t) ++span;
  Basis b{span + 1 - order, std::vector<double>(order, 0.0), std::vector<double>(order, 0.0)};
  std::vector<double> lower{1};
  const auto ratio = [](double x, double y) { return y != 0 ? x / y : 0.0; };
  for (size_t k = 2; k <= order; ++k) {
    // lower[j] belongs to the control point span + 2 - k + j; of order k there is one more before.
    std::vector<double> higher(k, 0.0), slope(k, 0.0);
    for (size_t j = 0; j < k; ++j) {
      const size_t i = span + 1 - k + j;
      if (j > 0) {
        const double width = knots[i + k - 1] - knots[i];
        higher[j] += ratio(t - knots[i], width) * lower[j - 1];
        slope[j] += ratio(double(k - 1), width) * lower[j - 1];
      }
      if (j + 1 < k) {
        const double width = knots[i + k] - knots[i + 1];
        higher[j] += ratio(knots[i + k] - t, width) * lower[j];
        slope[j] -= ratio(double(k - 1), width) * lower[j];
      }
    }
    lower = std::move(higher);
    b.slope = std::move(slope);
  }
  b.value = std::move(lower);
  return b;
}

/// The point and the derivatives by u and v, with weights.
std::array<P4, 3> evaluate(const NurbsSurface& s, double u, double v) {
  const Basis bu = basis_at(s.u, u), bv = basis_at(s.v, v);
  std::array<P4, 3> r{};
  for (size_t j = 0; j < bv.value.size(); ++j)
    for (size_t i = 0; i < bu.value.size(); ++i) {
      const P4& p = s.points[(bv.first + j) * size_t(s.u.count) + bu.first + i];
      for (size_t c = 0; c < 4; ++c) {
        r[0][c] += bu.value[i] * bv.value[j] * p[c];
        r[1][c] += bu.slope[i] * bv.value[j] * p[c];
        r[2][c] += bu.value[i] * bv.slope[j] * p[c];
      }
    }
  return r;
}

}  // namespace

std::string check_axis(const SplineAxis& a) {
  if (a.order < 2 || a.order > kHighestOrder)
    return fmt::format("the order of a nurbs surface is from 2 to {}, not {}", kHighestOrder,
                       a.order);
  if (a.count < a.order)
    return fmt::format("a nurbs surface of order {} needs as many points, not {}", a.order,
                       a.count);
  if (a.knots.size() != size_t(a.count) + size_t(a.order))
    return fmt::format("a nurbs surface of order {} with {} points has {} knots, not {}", a.order,
                       a.count, a.count + a.order, a.knots.size());
  if (!std::is_sorted(a.knots.begin(), a.knots.end()))
    return "the knots of a nurbs surface must not decrease";
  return {};
}

std::string check_nurbs(const NurbsSurface& s) {
  for (const SplineAxis* a : {&s.u, &s.v}) {
    if (std::string why = check_axis(*a); !why.empty()) return why;
    const double first = a->knots[size_t(a->order) - 1], last = a->knots[size_t(a->count)];
    if (!(first <= a->begin && a->begin < a->end && a->end <= last))
      return "a nurbs surface must lie within its knots";
  }
  if (s.points.size() != size_t(s.u.count) * size_t(s.v.count))
    return fmt::format("a nurbs surface of {} x {} points has {}", s.u.count, s.v.count,
                       s.points.size());
  for (const P4& p : s.points)
    if (!(p[3] > 0)) return "the weights of a nurbs surface must be greater than zero";
  return {};
}

TriangleMesh make_nurbs(const NurbsSurface& s) {
  const auto parameter = [](const SplineAxis& a, double share) {
    return a.begin + share * (a.end - a.begin);
  };
  TriangleMesh mesh = make_grid(kPoints - 1, kPoints - 1, [&](double x, double y) {
    const auto [p, du, dv] = evaluate(s, parameter(s.u, x), parameter(s.v, y));
    const auto derivative = [&p = p](const P4& d) {
      Vector3f r;
      for (int c = 0; c < 3; ++c) r[c] = float((d[size_t(c)] - p[size_t(c)] / p[3] * d[3]) / p[3]);
      return r;
    };
    return GridPoint{{float(p[0] / p[3]), float(p[1] / p[3]), float(p[2] / p[3])},
                     Normal3f(cross(derivative(du), derivative(dv)))};
  });
  for (Point2f& g : mesh.uvs)
    g = {float(parameter(s.u, double(g.x))), float(parameter(s.v, double(g.y)))};
  return mesh;
}

}  // namespace duet::pbrt
