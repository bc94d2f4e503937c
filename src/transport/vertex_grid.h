// Finds the points that lie within a fixed radius: a hash grid, for merging photons.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/parallel.h"
#include "math/batch.h"
#include "math/hash.h"
#include "math/vector.h"

namespace duet {

/// Photons in the cells around a vertex from which on only some of them are merged: all light on
/// one spot must not make the time grow with the square of the photons.
inline constexpr size_t kMostMergedPhotons = 4096;

/// The cells of a grid and the buckets that they are hashed into.
struct GridCells {
  double inverse_size = 1;
  uint32_t bucket_mask = 0;

  /// Cell coordinates are clamped to ± this, and then wrapped to 32 bits, which only makes distant
  /// cells share buckets.
  static constexpr double kFarthest = 0x1p40;

  uint32_t coordinate(double x) const { return uint32_t(int64_t(shifted(x))); }
  /// The same with steps that there are for many numbers at once, which are slower for one.
  [[gnu::always_inline]] uint32_t coordinate_in_lanes(double x) const {
    constexpr double kIntegers = 0x1p52;
    const double s = shifted(x), nearest = (s + kIntegers) - kIntegers;
    const double down = nearest > s ? 1.0 : 0.0;
    return uint32_t(std::bit_cast<uint64_t>(nearest - down + kIntegers));
  }

  /// The lowest three bits tell neighbouring cells apart, so that the 2×2×2 of a query are in
  /// different buckets. Blocks of 8×8×8 cells remain together, in Morton order.
  /// Source of the factors: Teschner et al., "Optimized Spatial Hashing for Collision Detection of
  /// Deformable Objects", VMV 2003.
  [[gnu::always_inline]] uint32_t bucket(uint32_t x, uint32_t y, uint32_t z) const {
    const uint32_t block =
        mix32((x >> 3) * 73856093u ^ (y >> 3) * 19349663u ^ (z >> 3) * 83492791u);
    const uint32_t morton = (x & 2) << 2 | (y & 2) << 3 | (z & 2) << 4 |  //
                            (x & 4) << 4 | (y & 4) << 5 | (z & 4) << 6;
    const uint32_t parity = (x & 1) | (y & 1) << 1 | (z & 1) << 2;
    return (((block ^ morton) & ~7u) | parity) & bucket_mask;
  }
  [[gnu::always_inline]] uint32_t bucket(const Point3f& p) const {
    return bucket(coordinate(double(p.x)), coordinate(double(p.y)), coordinate(double(p.z)));
  }

 private:
  [[gnu::always_inline]] double shifted(double x) const {
    return std::min(std::max(0.0, x * inverse_size + kFarthest), 2 * kFarthest);
  }
};

/// Space is divided into cubic cells, a little wider than two radii, so that a query looks at
/// 2×2×2 of them. Cells are hashed into buckets, and the points are sorted by bucket, those of one
/// bucket by index.
class VertexGrid {
 public:
  /// The position of a point that is to be left out.
  static Point3f nowhere() { return Point3f(INFINITY); }

  /// Sorts `count` points; `position(i)` yields the i-th, and is called several times and on
  /// several threads. Points that are not finite are left out. `radius` is positive, and its square
  /// a normal number. The result is the same for any number of threads. Memory is kept for the next
  /// build.
  template <class Position>
  void build(uint32_t count, const Position& position, float radius, int threads);

  /// The buckets of the cells around a point.
  using Neighborhood = std::array<uint32_t, 8>;
  /// The same of many points.
  using NeighborhoodBatch = std::array<BatchArray<uint32_t>, 8>;

  /// Finds the cells of a later query around `p`, and asks the memory for what it will read of
  /// them, which is slow: there may be other things to do meanwhile.
  Neighborhood locate(const Point3f& p) const;

  /// The same for the first `n` points of a batch.
  void locate(int n, const BatchTriples& points, NeighborhoodBatch& around) const;

  /// Calls `visit(index, distance_squared)` for each point whose distance to p is less than the
  /// radius (in single precision), each once, in an order that depends only on the points and the
  /// radius. `around` is the point's.
  template <class Visit>
  void query(const Point3f& p, const Neighborhood& around, Visit&& visit) const;

  /// The same, but bounded in time: where more than `most` points are in the cells around p, only
  /// one in n of them is looked at, counted from one that `random()`, in [0, 1), chooses. Each has
  /// the chance 1 / n to be among them, and `visit(index, distance_squared, n)` is told.
  template <class Random, class Visit>
  void sample(const Point3f& p, const Neighborhood& around, size_t most, Random&& random,
              Visit&& visit) const;

  /// Entries that list() writes at a time, and so may write behind what it adds.
  static constexpr uint32_t kListAtOnce = 4;
  /// Adds to a list the numbers of those entries that sample() would look at for point i of a
  /// batch; returns its n. They are `most` at most.
  template <class Random>
  size_t list(const NeighborhoodBatch& around, int i, size_t most, Random&& random, uint32_t* list,
              int& count) const;
  /// Of `count` entries, each for a point of a batch given by its number, finds those that are
  /// nearer than the radius. The numbers of their points and their indices stand in front then, in
  /// the same order; returns how many there are.
  int select(int count, const BatchTriples& points, const uint32_t* entries, int32_t* numbers,
             uint32_t* indices) const;

  /// What is kept between builds: at most 16 bytes for every point and 8 for every bucket of the
  /// largest build so far. There are as many buckets as points, rounded up to a power of two, and
  /// at least 8.
  size_t memory_bytes() const;
  /// The same, at most, of a grid of so many vertices.
  static double memory_bytes(double count) {
    return count * double(sizeof(Entry) + 2 * sizeof(uint32_t));
  }
  float radius() const { return radius_; }

 private:
  struct alignas(16) Entry {
    Point3f position;
    uint32_t index;
  };
  static_assert(sizeof(Entry) == 16);

  /// Those of the cells around a point.
  struct Entries {
    uint32_t begin[8]{}, count[8]{};
    size_t total = 0;
  };
  template <class Bucket>
  Entries look_up(const Bucket& bucket) const;
  static size_t stride_of(const Entries& entries, size_t most) {
    return entries.total > most ? (entries.total + most - 1) / most : 1;
  }
  template <class Random, class Visit>
  static void for_each_entry(const Entries& entries, size_t stride, Random&& random, Visit&& visit);

  /// Cells are wider than two radii by this factor. Cell coordinates are non-decreasing functions
  /// of positions, and the errors of any two add up to less than 0x1p-10: points at most two radii
  /// apart are in the same cell or in neighbouring ones.
  static constexpr double kCellScale = 1 + 0x1p-10;

  /// While building, points are first distributed to parts (runs of buckets) small enough for a
  /// cache, by blocks of points. Before the points of a block are moved, slots[block * parts +
  /// part] says where the first of them goes that belongs to the part; afterwards, where they end.
  struct Plan {
    uint32_t count, blocks, parts;
    std::vector<uint32_t> slots;
    uint32_t begin(size_t block) const { return uint32_t(uint64_t(count) * block / blocks); }
    uint32_t* row(size_t block) { return slots.data() + block * parts; }
  };

  /// Sizes everything for these points; the grid is empty until it is built.
  Plan start(uint32_t count, float radius, int threads);
  /// Turns the numbers of points per block and part into slots.
  static void assign_slots(Plan& plan);
  /// Sorts the points within their parts.
  void sort_parts(const Plan& plan, int threads);
  void sort_part(uint32_t part, uint32_t begin, uint32_t end);

  float radius_ = 1;
  GridCells cells_;
  int part_shift_ = 0;  ///< a bucket's part is its number without so many low bits
  uint32_t size_ = 0;   ///< number of entries in use
  size_t entry_capacity_ = 0, start_capacity_ = 0;
  std::unique_ptr<Entry[]> entries_;
  std::unique_ptr<uint32_t[]> starts_;  ///< bucket b is entries_[starts_[b]] to [starts_[b + 1]]
};

template <class Position>
void VertexGrid::build(uint32_t count, const Position& position, float radius, int threads) {
  Plan plan = start(count, radius, threads);
  const auto for_each_in = [&](size_t block, const auto& use) {
    for (uint32_t i = plan.begin(block), end = plan.begin(block + 1); i < end; ++i) {
      const Point3f p = position(i);
      if (is_finite(p)) use(p, i);
    }
  };
  parallel_for(plan.blocks, threads, [&](size_t block) {
    uint32_t* const counts = plan.row(block);
    for_each_in(block,
                [&](const Point3f& p, uint32_t) { ++counts[cells_.bucket(p) >> part_shift_]; });
  });
  assign_slots(plan);
  parallel_for(plan.blocks, threads, [&](size_t block) {
    uint32_t* const slots = plan.row(block);
    for_each_in(block, [&](const Point3f& p, uint32_t i) {
      entries_[slots[cells_.bucket(p) >> part_shift_]++] = {p, i};
    });
  });
  sort_parts(plan, threads);
}

inline VertexGrid::Neighborhood VertexGrid::locate(const Point3f& p) const {
  // The lowest of 2×2×2 cells. A point beyond them is not taken for near: differences are rounded,
  // but never from above the radius to below it.
  const double r = double(radius_);
  const uint32_t x = cells_.coordinate(double(p.x) - r), y = cells_.coordinate(double(p.y) - r),
                 z = cells_.coordinate(double(p.z) - r);
  Neighborhood around;
  for (uint32_t k = 0; k < 8; ++k) {
    around[k] = cells_.bucket(x + (k & 1), y + (k >> 1 & 1), z + (k >> 2));
    if (size_ > 0) __builtin_prefetch(starts_.get() + around[k]);
  }
  return around;
}

template <class Visit>
void VertexGrid::query(const Point3f& p, const Neighborhood& around, Visit&& visit) const {
  sample(
      p, around, size_, [] { return 0.0f; },
      [&](uint32_t index, float distance_squared, size_t) { visit(index, distance_squared); });
}

template <class Random, class Visit>
void VertexGrid::sample(const Point3f& p, const Neighborhood& around, size_t most, Random&& random,
                        Visit&& visit) const {
  const Entries entries = look_up([&](int k) { return around[size_t(k)]; });
  const size_t stride = stride_of(entries, most);
  const float radius_squared = sqr(radius_);
  for_each_entry(entries, stride, random, [&](uint32_t number) {
    const Entry& e = entries_[number];
    const float distance_squared = length_squared(e.position - p);
    if (distance_squared < radius_squared) visit(e.index, distance_squared, stride);
  });
}

template <class Bucket>
VertexGrid::Entries VertexGrid::look_up(const Bucket& bucket) const {
  Entries found;
  if (size_ == 0) return found;
  for (int k = 0; k < 8; ++k) {
    const uint32_t b = bucket(k);
    found.begin[k] = starts_[b], found.count[k] = starts_[b + 1] - starts_[b];
    found.total += found.count[k];
    if (found.count[k] > 0) __builtin_prefetch(entries_.get() + found.begin[k]);
  }
  return found;
}

template <class Random, class Visit>
void VertexGrid::for_each_entry(const Entries& entries, size_t stride, Random&& random,
                                Visit&& visit) {
  size_t skip = 0;
  if (stride > 1) skip = std::min(stride - 1, size_t(random() * float(stride)));
  for (int k = 0; k < 8; ++k) {
    const size_t count = entries.count[k];
    for (; skip < count; skip += stride) visit(entries.begin[k] + uint32_t(skip));
    skip -= count;
  }
}

template <class Random>
size_t VertexGrid::list(const NeighborhoodBatch& around, int i, size_t most, Random&& random,
                        uint32_t* list, int& count) const {
  const Entries entries = look_up([&](int k) { return around[size_t(k)][i]; });
  const size_t stride = stride_of(entries, most);
  if (stride > 1) {
    for_each_entry(entries, stride, random, [&](uint32_t number) { list[count++] = number; });
    return stride;
  }
  for (int k = 0; k < 8; ++k) {
    // Most cells have no more than this: to write some in vain takes less time than to find out.
    uint32_t* const end = list + count;
    for (uint32_t j = 0; j < kListAtOnce; ++j) end[j] = entries.begin[k] + j;
    for (uint32_t j = kListAtOnce; j < entries.count[k]; ++j) end[j] = entries.begin[k] + j;
    count += int(entries.count[k]);
  }
  return 1;
}

}  // namespace duet
