#include "transport/vertex_grid.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>

#include "math/sampler.h"

using namespace duet;

namespace {

struct Found {
  uint32_t index;
  float distance_squared;
  bool operator==(const Found&) const = default;
};
using Points = std::vector<Point3f>;

/// Random points in [-0.5, 0.5)³, the same for the same seed.
Points random_points(uint32_t count, uint64_t seed) {
  Sampler sampler(SampleSequence::independent, seed, 0, 0);
  Points points;
  for (uint32_t i = 0; i < count; ++i) {
    sampler.start_sample(i);
    const Point2f xy = sampler.next_2d();
    points.emplace_back(xy.x - 0.5f, xy.y - 0.5f, sampler.next_1d() - 0.5f);
  }
  return points;
}

Points scaled(Points points, float scale, const Vector3f& shift = Vector3f(0.0f)) {
  for (Point3f& p : points) p = Point3f(Vector3f(p) * scale + shift);
  return points;
}

void build(VertexGrid& grid, const Points& points, float radius, int threads = 2) {
  grid.build(
      uint32_t(points.size()), [&](uint32_t i) { return points[i]; }, radius, threads);
}

std::vector<Found> ask(const VertexGrid& grid, const Point3f& p) {
  std::vector<Found> found;
  grid.query(p, grid.locate(p), [&](uint32_t index, float d) { found.push_back({index, d}); });
  return found;
}

/// What list() and select() find for the first points of a list, in order: indices by query.
std::vector<std::vector<uint32_t>> ask_batch(const VertexGrid& grid, const Points& queries,
                                             size_t most, float random = 0) {
  const int n = int(std::min(queries.size(), size_t(kBatch)));
  auto around = std::make_unique<VertexGrid::NeighborhoodBatch>();
  auto points = std::make_unique<BatchTriples>();
  for (int i = 0; i < n; ++i) points->set(i, queries[size_t(i)]);
  grid.locate(n, *points, *around);
  std::vector<std::vector<uint32_t>> found(static_cast<size_t>(n));
  for (int i = 0; i < n; ++i) {
    std::vector<uint32_t> list(std::min(most, size_t(1) << 16) + VertexGrid::kListAtOnce);
    int count = 0;
    grid.list(
        *around, i, most, [&] { return random; }, list.data(), count);
    std::vector<int32_t> numbers(size_t(count), i);
    const int near = grid.select(count, *points, list.data(), numbers.data(), list.data());
    for (int k = 0; k < near; ++k) {
      REQUIRE(numbers[size_t(k)] == i);
      found[size_t(i)].push_back(list[size_t(k)]);
    }
  }
  return found;
}

/// What a query has to find, by index.
std::vector<Found> brute_force(const Points& points, const Point3f& p, float radius) {
  std::vector<Found> found;
  for (uint32_t i = 0; i < points.size(); ++i) {
    const float d = length_squared(points[i] - p);
    if (d < radius * radius) found.push_back({i, d});
  }
  return found;
}

/// Compares all queries with brute force; returns how many points were found.
size_t compare(const Points& points, const Points& queries, float radius) {
  VertexGrid grid;
  build(grid, points, radius);
  CHECK(grid.radius() == radius);
  size_t wrong = 0, total = 0;
  const auto batch = ask_batch(grid, queries, points.size());
  for (const Point3f& q : queries) {
    auto found = ask(grid, q);
    if (const auto i = size_t(&q - queries.data()); i < batch.size())
      wrong += !std::equal(found.begin(), found.end(), batch[i].begin(), batch[i].end(),
                           [](const Found& f, uint32_t index) { return f.index == index; });
    std::sort(found.begin(), found.end(),
              [](const Found& a, const Found& b) { return a.index < b.index; });
    wrong += found != brute_force(points, q, radius);
    total += found.size();
  }
  CHECK(wrong == 0);
  return total;
}

}  // namespace

TEST_CASE("vertex grid finds what brute force finds, at any scale and radius") {
  const Points unit = random_points(1000, 1), asked = random_points(100, 2);
  for (const float scale : {1e-6f, 1e-3f, 1.0f, 1e3f, 1e6f}) {
    for (const float radius : {0.003f, 0.05f, 0.2f, 0.7f, 3.0f}) {
      CAPTURE(scale);
      CAPTURE(radius);
      const float r = scale * radius;
      const Points points = scaled(unit, scale);
      CHECK(compare(points, points, r) >= points.size());
      const size_t total = compare(points, scaled(asked, 1.5f * scale), r);
      if (radius == 3) CHECK(total == points.size() * asked.size());
      // Far from the origin, where coordinates are coarse.
      const Vector3f shift = scale * Vector3f(1e4f, -3e4f, 1e5f);
      compare(scaled(unit, scale, shift), scaled(asked, scale, shift), r);
    }
  }
}

TEST_CASE("vertex grid looks at some of the points of a crowd, each with the same chance") {
  const Points points = scaled(random_points(5000, 21), 0.01f);
  VertexGrid grid;
  build(grid, points, 0.008f);
  const Point3f p = points[7];
  const size_t all = ask(grid, p).size();
  REQUIRE(all > 500);
  for (const size_t most : {size_t(50), size_t(100), size_t(777)}) {
    CAPTURE(most);
    std::vector<int> visits(points.size());
    size_t share = 0, passes = 0;
    for (const float random : {0.0f, 0.3f, 0.999f}) {
      std::vector<uint32_t> indices;
      grid.sample(
          p, grid.locate(p), most, [&] { return random; },
          [&](uint32_t index, float, size_t) { indices.push_back(index); });
      CHECK(ask_batch(grid, {p}, most, random)[0] == indices);
    }
    // Every way to begin: each point is found once, and counted as often as there are ways.
    for (size_t first = 0; first == 0 || first < share; ++first, ++passes) {
      size_t looked = 0;
      grid.sample(
          p, grid.locate(p), most,
          [&] { return share > 0 ? (float(first) + 0.5f) / float(share) : 0.0f; },
          [&](uint32_t index, float, size_t n) {
            ++visits[index], ++looked;
            share = n;
          });
      CHECK(looked <= most);
      REQUIRE(share > 0);
    }
    CHECK(std::count(visits.begin(), visits.end(), 1) == long(all));
    CHECK(std::count(visits.begin(), visits.end(), 0) == long(points.size() - all));
    CHECK(passes == share);
  }
  size_t found = 0;
  grid.sample(
      p, grid.locate(p), points.size(), [] { return 0.9f; },
      [&](uint32_t, float, size_t n) {
        CHECK(n == 1);
        ++found;
      });
  CHECK(found == all);
}

TEST_CASE("vertex grid finds points on axis-aligned planes from queries on them") {
  for (int axis = 0; axis < 3; ++axis) {
    for (const float height : {0.0f, -0.5f, 0.3f, 1.0f}) {
      Points points = random_points(1500, 3), queries = random_points(100, 4);
      for (Point3f& p : points) p[axis] = height;
      for (Point3f& q : queries) q[axis] = height;
      for (const float radius : {0.01f, 0.05f, 0.25f}) CHECK(compare(points, queries, radius) > 0);
    }
  }
}

TEST_CASE("vertex grid leaves out lattice points at just the radius") {
  Points points, queries;
  for (int i = 0; i < 11 * 11 * 11; ++i) {
    points.emplace_back(float(i % 11 - 5), float(i / 11 % 11 - 5), float(i / 121 - 5));
    if (max_abs(points.back()) < 4) queries.push_back(points.back());
  }
  CHECK(compare(points, queries, 1) == queries.size());
  CHECK(compare(points, queries, 1.0625f) == 7 * queries.size());
  CHECK(compare(points, queries, 1.5f) == 19 * queries.size());
  CHECK(compare(points, queries, 2) == 27 * queries.size());
}

TEST_CASE("vertex grid misses no point at the edge of the sphere") {
  // Queries anywhere and about one radius from corners of cells; points left, right, below, above,
  // behind and before them, as far away as rounding lets them be.
  constexpr float radius = 0.125f;
  for (const float corner : {0.0f, 3.0f, -7.0f, 1000.0f}) {
    Points points, queries = scaled(random_points(300, 15), 10, Vector3f(corner));
    for (int i = -40; i <= 40; ++i)
      queries.emplace_back(radius * (2 * corner + 1 + float(i) * 0x1p-14f));
    for (const Point3f& q : queries) {
      points.push_back(q);
      for (int j = -2; j <= 6; ++j) {
        const float d = radius * (1 - float(j) * 0x1p-24f);
        for (int axis = 0; axis < 6; ++axis) {
          points.push_back(q);
          points.back()[axis / 2] += axis % 2 ? d : -d;
        }
      }
    }
    CHECK(compare(points, queries, radius) > 0);
  }
}

TEST_CASE("vertex grid visits each of many equal or close points once") {
  for (const float spread : {0.0f, 1e-5f, 1e-3f}) {
    Points points = scaled(random_points(2000, 5), spread, {7, 7, 7});
    points.resize(4000, points[0]);
    CHECK(compare(points, scaled(random_points(30, 6), 0.01f, {7, 7, 7}), 0.5f) == 30 * 4000);
  }
  // Few points have few buckets, shared by many cells.
  for (uint32_t count = 1; count < 40; ++count)
    compare(random_points(count, 7), random_points(100, 8), 0.05f + 0.01f * float(count));
}

TEST_CASE("vertex grid stays right with more cells than there are integers") {
  Points points = scaled(random_points(500, 9), 2e6f);
  for (int i = 0; i < 300; ++i) points.push_back(points[size_t(i)]);
  points.emplace_back(3e38f, -3e38f, 3e38f), points.emplace_back(1e-30f, 0.0f, -1e-38f);
  for (const float radius : {1e-12f, 1e-6f, 1.0f}) CHECK(compare(points, points, radius) > 1000);
}

TEST_CASE("vertex grid drops what is not finite and finds nothing far away") {
  Points points = random_points(500, 10);
  for (uint32_t i = 0; i < 500; i += 5)
    points[i][int(i / 5 % 3)] = i % 2 ? std::nanf("") : i % 4 ? INFINITY : -INFINITY;
  CHECK(compare(points, {{0, 0, 0}, {0.5f, 0.5f, 0.5f}}, 3) == 2 * 400);
  VertexGrid grid;
  build(grid, points, 0.1f);
  for (const float x : {NAN, INFINITY, -INFINITY, 3e38f, -3e38f, 1e10f, 1e5f, -2.0f})
    for (int axis = 0; axis < 3; ++axis) {
      Point3f p(0, 0, 0);
      p[axis] = x;
      CHECK(ask(grid, p).empty());
    }
}

TEST_CASE("vertex grid can be empty") {
  VertexGrid grid;
  CHECK(ask(grid, {0, 0, 0}).empty());
  CHECK(grid.memory_bytes() == 0);
  build(grid, {{0, 0, 0}}, 1);
  CHECK(ask(grid, {0, 0, 0}).size() == 1);
  build(grid, {}, 1);
  CHECK(ask(grid, {0, 0, 0}).empty());
  build(grid, {{NAN, 0, 0}, {0, INFINITY, 0}}, 1);
  CHECK(ask(grid, {0, 0, 0}).empty());
}

TEST_CASE("vertex grid visits in the same order whatever the number of threads") {
  // Enough for several parts and blocks.
  Points points = random_points(150000, 11);
  for (size_t i = 0; i < points.size(); i += 3) points[i].z = 0.25f;
  for (size_t i = 0; i < 20000; ++i) points[2 * i] = {0.125f, 0.25f, 0.375f};
  points[777].x = NAN;
  Points queries = random_points(200, 12);
  for (size_t i = 0; i < 100; ++i) queries[i].z = 0.25f;
  for (const float radius : {0.02f, 0.2f}) {
    VertexGrid grids[3];
    const int threads[3] = {1, 2, 7};
    for (int i = 0; i < 3; ++i) build(grids[i], points, radius, threads[i]);
    size_t different = 0, total = 0;
    for (const Point3f& q : queries) {
      const auto found = ask(grids[0], q);
      total += found.size();
      different += found != ask(grids[1], q) || found != ask(grids[2], q);
    }
    CHECK(different == 0);
    CHECK(total > 1000);
    // Within a bucket the order is by index.
    const auto heap = ask(grids[2], points[0]);
    REQUIRE(heap.size() >= 20000);
    uint32_t last = 0;
    bool sorted = true;
    for (const Found& f : heap) {
      if (f.distance_squared != 0) continue;
      sorted = sorted && f.index >= last;
      last = f.index;
    }
    CHECK(sorted);
  }
}

TEST_CASE("vertex grid keeps within its memory and uses it again") {
  for (const uint32_t count : {0u, 1u, 2u, 7u, 8u, 9u, 1000u, 1024u, 1025u, 70000u}) {
    VertexGrid grid;
    const Points points = random_points(count, 13), few = random_points(count / 3, 14);
    build(grid, points, 0.1f);
    const size_t memory = grid.memory_bytes();
    CHECK(memory >= 16 * size_t(count));
    CHECK(memory <= 16 * size_t(count) + 8 * std::max<size_t>(8, std::bit_ceil(count)));
    // What the last build left behind is not found.
    build(grid, few, 0.2f);
    CHECK(grid.memory_bytes() == memory);
    CHECK(ask(grid, {0, 0, 0}).size() == brute_force(few, {0, 0, 0}, 0.2f).size());
    build(grid, points, 0.2f);
    CHECK(grid.memory_bytes() == memory);
    CHECK(ask(grid, {0, 0, 0}).size() == brute_force(points, {0, 0, 0}, 0.2f).size());
  }
}
