// Time to build a grid over points and to find those near another, for VertexGrid and for a plain
// grid: what sorting small records along a Morton curve is worth.
//
//   grid_bench [POINTS]     default: 3500000
#include <fmt/format.h>

#include <bit>
#include <chrono>
#include <cstdlib>
#include <numeric>
#include <vector>

#include "cpu_time.h"
#include "math/sampler.h"
#include "math/warp.h"
#include "transport/vertex_grid.h"

using namespace duet;

namespace {

/// As large as the vertices of light paths are.
struct Vertex {
  Point3f position;
  float payload[13];
};
static_assert(sizeof(Vertex) == 64);

/// Vertex numbers sorted by cell; cells, two radii wide, are numbered row by row and go around a
/// table with a bucket for every point.
class PlainGrid {
 public:
  void build(const std::vector<Vertex>& vertices, float radius) {
    vertices_ = &vertices;
    radius_squared_ = sqr(radius);
    inverse_cell_size_ = 1 / (2 * radius);
    width_ = uint32_t(inverse_cell_size_) + 3;  // the points are in the unit cube
    mask_ = uint32_t(std::bit_ceil(vertices.size()) - 1);
    starts_.assign(size_t(mask_) + 2, 0);
    for (const Vertex& v : vertices) ++starts_[bucket(v.position)];
    std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
    numbers_.resize(vertices.size());
    for (uint32_t i = uint32_t(vertices.size()); i-- > 0;)
      numbers_[--starts_[bucket(vertices[i].position)]] = i;
  }

  struct Neighborhood {};
  Neighborhood locate(const Point3f&) const { return {}; }

  template <class Visit>
  void query(const Point3f& p, Neighborhood, const Visit& visit) const {
    const uint32_t x = cell(p.x - 0.5f / inverse_cell_size_),
                   y = cell(p.y - 0.5f / inverse_cell_size_),
                   z = cell(p.z - 0.5f / inverse_cell_size_);
    uint32_t buckets[8];
    for (uint32_t k = 0; k < 8; ++k) {
      buckets[k] = bucket(x + (k & 1), y + (k >> 1 & 1), z + (k >> 2));
      if (std::find(buckets, buckets + k, buckets[k]) != buckets + k) continue;
      for (uint32_t i = starts_[buckets[k]]; i < starts_[buckets[k] + 1]; ++i) {
        const float d = length_squared((*vertices_)[numbers_[i]].position - p);
        if (d < radius_squared_) visit(numbers_[i], d);
      }
    }
  }

 private:
  uint32_t cell(float x) const { return uint32_t(x * inverse_cell_size_ + 1); }
  uint32_t bucket(uint32_t x, uint32_t y, uint32_t z) const {
    return (x + width_ * (y + width_ * z)) & mask_;
  }
  uint32_t bucket(const Point3f& p) const { return bucket(cell(p.x), cell(p.y), cell(p.z)); }

  const std::vector<Vertex>* vertices_ = nullptr;
  float radius_squared_ = 0, inverse_cell_size_ = 0;
  uint32_t width_ = 0, mask_ = 0;
  std::vector<uint32_t> starts_, numbers_;
};

constexpr uint32_t kSurfaces = 7;
constexpr float kSphereRadius = 0.28f;
constexpr double kArea = 6 + 4 * double(kPi) * double(kSphereRadius) * double(kSphereRadius);

/// A point of the unit cube's walls or of a sphere in it.
Point3f point_of(uint32_t surface, const Point2f& u) {
  const float wall = float(surface % 2);
  if (surface < 2) return {wall, u.x, u.y};
  if (surface < 4) return {u.x, wall, u.y};
  if (surface < 6) return {u.x, u.y, wall};
  return Point3f(0.5f) + square_to_sphere(u) * kSphereRadius;
}

/// Queries row by row, as the pixels of an image ask them, or in random order.
std::vector<Point3f> make_queries(bool random) {
  constexpr uint32_t kWidth = 200;
  Sampler sampler(SampleSequence::independent, 2, 0, 0);
  std::vector<Point3f> queries;
  for (uint32_t i = 0; i < kSurfaces * kWidth * kWidth; ++i) {
    sampler.start_sample(i);
    Point2f u = sampler.next_2d();
    if (!random)
      u = (u + Point2f{float(i % kWidth), float(i / kWidth % kWidth)}) * (1 / float(kWidth));
    queries.push_back(point_of(random ? i % kSurfaces : i / (kWidth * kWidth), u));
  }
  return queries;
}

/// Results go here, so that the compiler cannot leave out the work.
volatile float sink;

double wall_time() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
double cpu_time() {
  return cpu_seconds(CLOCK_THREAD_CPUTIME_ID);
}

/// The smallest of a few measurements, so that other programs count less.
struct Smallest {
  double value = 1e300;
  void add(double v) { value = std::min(value, v); }
};

template <class F>
double time_of(double (*clock)(), const F& f) {
  const double start = clock();
  f();
  return clock() - start;
}

/// Nanoseconds per query; `found` becomes the mean number of points.
template <class Grid>
double time_queries(const Grid& grid, const std::vector<Point3f>& queries, double& found) {
  uint64_t count = 0;
  float sum = 0;
  const double seconds = time_of(cpu_time, [&] {
    for (const Point3f& q : queries)
      grid.query(q, grid.locate(q),
                 [&](uint32_t index, float d) { ++count, sum += d + float(index & 1); });
  });
  sink = sum;
  found = double(count) / double(queries.size());
  return seconds * 1e9 / double(queries.size());
}

void measure(const std::vector<Vertex>& vertices, const std::vector<Point3f> (&queries)[2],
             double wanted) {
  const float radius = float(std::sqrt(wanted * kArea / (double(kPi) * double(vertices.size()))));
  const uint32_t count = uint32_t(vertices.size());
  const auto position = [&](uint32_t i) { return vertices[i].position; };
  const int all = HardwareThreads().count();
  VertexGrid grid;
  PlainGrid plain;
  Smallest builds[3], times[2][2];
  double found = 0, plain_found = 0;
  for (int round = 0; round < 3; ++round) {
    builds[0].add(time_of(cpu_time, [&] { plain.build(vertices, radius); }));
    builds[1].add(time_of(cpu_time, [&] { grid.build(count, position, radius, 1); }));
    builds[2].add(time_of(wall_time, [&] { grid.build(count, position, radius, all); }));
    for (const bool random : {false, true}) {
      times[random][0].add(time_queries(plain, queries[random], plain_found));
      times[random][1].add(time_queries(grid, queries[random], found));
      if (found != plain_found) fmt::print("the grids disagree: {} {}\n", found, plain_found);
    }
  }
  fmt::print("{:>8.1f}{:>10.0f}{:>10.0f}{:>10.0f}{:>12.0f}{:>10.0f}{:>12.0f}{:>10.0f}\n", found,
             builds[0].value * 1e3, builds[1].value * 1e3, builds[2].value * 1e3, times[0][0].value,
             times[0][1].value, times[1][0].value, times[1][1].value);
}

}  // namespace

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 3500000;
  if (count < 1) {
    fmt::print(stderr, "usage: grid_bench [POINTS]\n");
    return 2;
  }
  Sampler sampler(SampleSequence::independent, 1, 0, 0);
  std::vector<Vertex> vertices(static_cast<size_t>(count));
  for (uint32_t i = 0; i < uint32_t(count); ++i) {
    sampler.start_sample(i);
    const Point2f u = sampler.next_2d();
    const double at = double(sampler.next_1d()) * kArea;
    vertices[i].position = point_of(std::min(uint32_t(at), kSurfaces - 1), u);
  }
  fmt::print("{:>38}{:>22}{:>22}\n", "ms to build", "ns in image order", "ns in random order");
  fmt::print("{:>8}{:>10}{:>10}{:>7} thr.{:>10}{:>10}{:>12}{:>10}\n", "found", "plain", "grid",
             HardwareThreads().count(), "plain", "grid", "plain", "grid");
  const std::vector<Point3f> queries[2] = {make_queries(false), make_queries(true)};
  for (const double wanted : {3.0, 10.0, 40.0}) measure(vertices, queries, wanted);
}
