#include "geometry/sdf_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace duet {

namespace {

using Double3 = std::array<double, 3>;
using Cell = std::array<int, 3>;

Cell lower_corner(const SdfGrid& grid, uint32_t cell) {
  const int nx = grid.size[0], ny = grid.size[1], i = int(cell);
  return {i % nx, i / nx % ny, i / nx / ny};
}

/// The distance within a cell as a polynomial: Σ k[i] of the products of coordinates whose bits are
/// set in i (1: x, 2: y, 4: z), each from 0 to 1.
struct Trilinear {
  double k[8];

  Trilinear(const SdfGrid& grid, const Cell& c) {
    for (int i = 0; i < 8; ++i)
      k[i] = double(grid.at(c[0] + (i & 1), c[1] + (i >> 1 & 1), c[2] + (i >> 2)));
    for (int bit = 1; bit < 8; bit *= 2)
      for (int i = 0; i < 8; ++i)
        if (i & bit) k[i] -= k[i ^ bit];
  }
  double operator()(const Double3& p) const {
    const double x = p[0], y = p[1], z = p[2];
    return k[0] + k[1] * x + y * (k[2] + k[3] * x) + z * (k[4] + k[5] * x + y * (k[6] + k[7] * x));
  }
  Double3 gradient(const Double3& p) const {
    const double x = p[0], y = p[1], z = p[2];
    return {k[1] + k[3] * y + z * (k[5] + k[7] * y), k[2] + k[3] * x + z * (k[6] + k[7] * x),
            k[4] + k[5] * x + y * (k[6] + k[7] * x)};
  }
};

/// c[0] + c[1] t + c[2] t² + c[3] t³
struct Cubic {
  double c[4];
  double operator()(double t) const { return c[0] + t * (c[1] + t * (c[2] + t * c[3])); }
  double slope(double t) const { return c[1] + t * (2 * c[2] + t * 3 * c[3]); }
};

/// The distance along the line o + t d.
Cubic along(const Trilinear& f, const Double3& o, const Double3& d) {
  // Multiplied out one coordinate after the other: first z, then y, then x.
  const auto line = [&](double a, double b, int i) {
    return std::array<double, 2>{a + b * o[size_t(i)], b * d[size_t(i)]};
  };
  std::array<double, 2> z[4];
  for (int i = 0; i < 4; ++i) z[i] = line(f.k[i], f.k[i + 4], 2);
  std::array<double, 3> y[2];
  for (int i = 0; i < 2; ++i)
    y[i] = {z[i][0] + z[i + 2][0] * o[1], z[i][1] + z[i + 2][1] * o[1] + z[i + 2][0] * d[1],
            z[i + 2][1] * d[1]};
  return {{y[0][0] + y[1][0] * o[0], y[0][1] + y[1][1] * o[0] + y[1][0] * d[0],
           y[0][2] + y[1][2] * o[0] + y[1][1] * d[0], y[1][2] * d[0]}};
}

/// The root of a function that is monotonic in [a, b] and changes its sign there: Newton's method,
/// with bisection where it leaves the interval.
double monotonic_root(const Cubic& f, double a, double b, double fa) {
  double t = 0.5 * (a + b);
  for (int i = 0; i < 100; ++i) {
    const double ft = f(t);
    if (ft == 0) return t;
    (ft < 0) == (fa < 0) ? a = t : b = t;
    double next = t - ft / f.slope(t);
    if (!(next > a && next < b)) next = 0.5 * (a + b);
    if (std::abs(next - t) <= 4 * std::numeric_limits<double>::epsilon() * std::abs(t)) return next;
    t = next;
  }
  return t;
}

}  // namespace

std::vector<uint32_t> surface_cells(const SdfGrid& grid) {
  std::vector<uint32_t> cells;
  for (int z = 0; z + 1 < grid.size[2]; ++z)
    for (int y = 0; y + 1 < grid.size[1]; ++y)
      for (int x = 0; x + 1 < grid.size[0]; ++x) {
        float least = INFINITY, most = -INFINITY;
        for (int i = 0; i < 8; ++i) {
          const float v = grid.at(x + (i & 1), y + (i >> 1 & 1), z + (i >> 2));
          least = std::min(least, v), most = std::max(most, v);
        }
        if (least <= 0 && most >= 0)
          cells.push_back(uint32_t((z * grid.size[1] + y) * grid.size[0] + x));
      }
  return cells;
}

void cell_bounds(const SdfGrid& grid, uint32_t cell, Point3f& lower, Point3f& upper) {
  const Cell c = lower_corner(grid, cell);
  for (int i = 0; i < 3; ++i) {
    const float width = 1 / float(grid.size[size_t(i)] - 1);
    lower[i] = float(c[size_t(i)]) * width;
    upper[i] = float(c[size_t(i)] + 1) * width;
  }
}

std::optional<double> intersect_cell(const SdfGrid& grid, uint32_t cell, const Double3& o,
                                     const Double3& d, double tnear, double tfar) {
  const Cell c = lower_corner(grid, cell);
  Double3 from, by;
  double begin = tnear, end = tfar;
  for (size_t i = 0; i < 3; ++i) {
    const double scale = grid.size[i] - 1;
    from[i] = o[i] * scale - c[i], by[i] = d[i] * scale;
    if (by[i] == 0) {
      if (from[i] < 0 || from[i] > 1) return std::nullopt;
      continue;
    }
    const double t0 = -from[i] / by[i], t1 = (1 - from[i]) / by[i];
    begin = std::max(begin, std::min(t0, t1)), end = std::min(end, std::max(t0, t1));
  }
  if (!(begin < end)) return std::nullopt;
  const Trilinear f(grid, c);
  for (size_t i = 0; i < 3; ++i) from[i] += begin * by[i];
  const Cubic cubic = along(f, from, by);
  // Between the extrema the cubic is monotonic.
  double bounds[4] = {0, end - begin, end - begin, end - begin};
  int n = 1;
  const double a = 3 * cubic.c[3], b = cubic.c[2], root2 = b * b - a * cubic.c[1];
  if (root2 > 0) {
    const double q = -(b + std::copysign(std::sqrt(root2), b));
    double extrema[2] = {q != 0 ? cubic.c[1] / q : 0, a != 0 ? q / a : 0};
    if (extrema[0] > extrema[1]) std::swap(extrema[0], extrema[1]);
    for (const double e : extrema)
      if (e > bounds[n - 1] && e < end - begin) bounds[n++] = e;
  }
  bounds[n] = end - begin;
  for (int i = 0; i < n; ++i) {
    const double fa = cubic(bounds[i]), fb = cubic(bounds[i + 1]);
    if (fa == 0 || (fa < 0) == (fb < 0)) continue;
    const double t = begin + monotonic_root(cubic, bounds[i], bounds[i + 1], fa);
    return t > tnear && t < tfar ? std::optional(t) : std::nullopt;
  }
  return std::nullopt;
}

namespace {

/// The continuous normal: gradients of the eight cells around the node nearest to p, each a
/// difference across its cell where p is along the other axes, are normalised and interpolated.
/// Cells outside of the grid do not count. `p` is in units of cells.
Normal3f smooth_normal(const SdfGrid& grid, const Double3& p) {
  Cell first, own;
  Double3 weight, inside;
  for (size_t i = 0; i < 3; ++i) {
    const int cells = grid.size[i] - 1;
    first[i] = int(std::lround(p[i])) - 1;
    weight[i] = p[i] - first[i] - 0.5;
    if (first[i] < 0) weight[i] = 1;
    if (first[i] + 1 >= cells) weight[i] = first[i] < 0 ? weight[i] : 0;
    own[i] = std::clamp(int(std::floor(p[i])), 0, cells - 1);
    inside[i] = p[i] - own[i];
  }
  // Interpolated distance in the plane where coordinate `axis` is `node`, at p along the others.
  const auto plane = [&](size_t axis, int node) {
    const size_t b = (axis + 1) % 3, c = (axis + 2) % 3;
    double sum = 0;
    for (int i = 0; i < 4; ++i) {
      Cell q;
      q[axis] = std::clamp(node, 0, grid.size[axis] - 1);
      q[b] = own[b] + (i & 1), q[c] = own[c] + (i >> 1);
      sum += (i & 1 ? inside[b] : 1 - inside[b]) * (i >> 1 ? inside[c] : 1 - inside[c]) *
             double(grid.at(q[0], q[1], q[2]));
    }
    return sum;
  };
  double difference[3][2];
  for (size_t axis = 0; axis < 3; ++axis)
    for (int k = 0; k < 2; ++k) {
      const int node = first[axis] + k;
      difference[axis][k] = (plane(axis, node + 1) - plane(axis, node)) * (grid.size[axis] - 1);
    }
  Double3 sum{};
  for (int i = 0; i < 8; ++i) {
    const Double3 g{difference[0][i & 1], difference[1][i >> 1 & 1], difference[2][i >> 2]};
    double w = 1;
    for (size_t axis = 0; axis < 3; ++axis) w *= i >> axis & 1 ? weight[axis] : 1 - weight[axis];
    const double l = std::sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    if (w > 0 && l > 0)
      for (size_t axis = 0; axis < 3; ++axis) sum[axis] += w / l * g[axis];
  }
  return {float(sum[0]), float(sum[1]), float(sum[2])};
}

}  // namespace

SdfPoint surface_point(const SdfGrid& grid, uint32_t cell, const Double3& p) {
  const Cell c = lower_corner(grid, cell);
  Double3 local, scale;
  for (size_t i = 0; i < 3; ++i) {
    scale[i] = grid.size[i] - 1;
    local[i] = std::clamp(p[i] * scale[i] - c[i], 0.0, 1.0);
  }
  const Trilinear f(grid, c);
  const Double3 g = f.gradient(local);
  const double g2 = g[0] * g[0] + g[1] * g[1] + g[2] * g[2];
  SdfPoint s;
  Double3 unit;
  const double value = f(local);
  for (size_t i = 0; i < 3; ++i) {
    if (g2 > 0) local[i] = std::clamp(local[i] - value * g[i] / g2, 0.0, 1.0);
    unit[i] = c[i] + local[i];
    s.position[int(i)] = float(unit[i] / scale[i]);
    s.geometric[int(i)] = float(g[i] * scale[i]);
  }
  s.shading = grid.smooth_normals ? smooth_normal(grid, unit) : s.geometric;
  return s;
}

}  // namespace duet
