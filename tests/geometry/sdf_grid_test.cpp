#include "geometry/sdf_grid.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

using namespace duet;

namespace {

using Local = std::array<double, 3>;

/// Distances to a sphere around the middle of the unit cube.
SdfGrid ball(int n, double radius) {
  SdfGrid grid;
  grid.size = {n, n + 1, n + 2};
  for (int z = 0; z < grid.size[2]; ++z)
    for (int y = 0; y < grid.size[1]; ++y)
      for (int x = 0; x < grid.size[0]; ++x)
        grid.values.push_back(float(
            std::hypot(x / double(n - 1) - 0.5, y / double(n) - 0.5, z / double(n + 1) - 0.5) -
            radius));
  grid.cells = surface_cells(grid);
  return grid;
}

/// The nearest intersection with any cell.
bool first_hit(const SdfGrid& grid, const Local& o, const Local& d, double& t, uint32_t& cell) {
  double nearest = INFINITY;
  for (const uint32_t c : grid.cells) {
    if (const auto s = intersect_cell(grid, c, o, d, 0, nearest)) nearest = *s, cell = c;
  }
  t = nearest;
  return nearest < INFINITY;
}

}  // namespace

TEST_CASE("sdf grid: rays meet a ball where they should, and its normals point outwards") {
  const SdfGrid grid = ball(24, 0.4);
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform(-0.2, 0.2);
  for (int i = 0; i < 300; ++i) {
    const Local target{0.5 + uniform(generator), 0.5 + uniform(generator),
                       0.5 + uniform(generator)};
    const double angle = 30 * uniform(generator);
    const Local o{0.5 + 2 * std::cos(angle), 0.5 + 2 * std::sin(angle), 0.5 + uniform(generator)};
    const Local d{target[0] - o[0], target[1] - o[1], target[2] - o[2]};
    double t;
    uint32_t cell;
    REQUIRE(first_hit(grid, o, d, t, cell));
    const Local p{o[0] + t * d[0], o[1] + t * d[1], o[2] + t * d[2]};
    // Trilinear interpolation of a distance errs by about the square of a cell over the radius.
    CHECK(std::hypot(p[0] - 0.5, p[1] - 0.5, p[2] - 0.5) == doctest::Approx(0.4).epsilon(0.005));
    const SdfPoint s = surface_point(grid, cell, p);
    CHECK(length(s.position - Point3f(float(p[0]), float(p[1]), float(p[2]))) < 1e-6f);
    const Vector3f out = normalize(s.position - Point3f(0.5f));
    CHECK(dot(normalize(Vector3f(s.geometric)), out) > 0.99f);
    CHECK(dot(normalize(Vector3f(s.shading)), out) > 0.998f);
  }
}

TEST_CASE("sdf grid: no ray gets through between cells") {
  const SdfGrid grid = ball(9, 0.4);
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 3000; ++i) {
    // From the middle, also straight along faces and edges of cells.
    Local d{uniform(generator) - 0.5, uniform(generator) - 0.5, uniform(generator) - 0.5};
    if (i % 3 == 0) d[size_t(i % 9 / 3)] = 0;
    if (i % 50 == 0) d = {1, 0, 0};
    double t;
    uint32_t cell;
    CHECK(first_hit(grid, {0.5, 0.5, 0.5}, d, t, cell));
  }
}

TEST_CASE("sdf grid: rays that miss, begin beyond or end before find nothing") {
  const SdfGrid grid = ball(16, 0.3);
  double t;
  uint32_t cell;
  CHECK_FALSE(first_hit(grid, {0.5, 0.5, -1}, {1, 0, 0}, t, cell));
  CHECK_FALSE(first_hit(grid, {0.95, 0.5, -1}, {0, 0, 1}, t, cell));
  REQUIRE(first_hit(grid, {0.5, 0.5, -1}, {0, 0, 1}, t, cell));
  CHECK(t == doctest::Approx(1.2).epsilon(0.005));
  CHECK_FALSE(intersect_cell(grid, cell, {0.5, 0.5, -1}, {0, 0, 1}, 0, t - 0.01));
  CHECK_FALSE(intersect_cell(grid, cell, {0.5, 0.5, -1}, {0, 0, 1}, t + 0.01, 9));
}

TEST_CASE("sdf grid: only cells with the surface count") {
  const SdfGrid grid = ball(16, 0.3);
  CHECK(grid.cells.size() > 100);
  CHECK(grid.cells.size() < 15 * 16 * 17 / 4);
  SdfGrid far = grid;
  for (float& v : far.values) v += 2;
  CHECK(surface_cells(far).empty());
}
