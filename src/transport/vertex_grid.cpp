#include "transport/vertex_grid.h"

#include <bit>
#include <utility>

#include "base/instruction_sets.h"

namespace duet {

namespace {

constexpr size_t kMinBuckets = 8;
/// With few blocks per thread one slow thread would keep the others waiting.
constexpr uint32_t kBlocksPerThread = 4;
constexpr uint32_t kMinBlockSize = 1 << 14;
constexpr size_t kMinPartBuckets = 1 << 12;
constexpr size_t kMaxParts = 1 << 10;

/// Makes room for n elements, whose values are lost and unset if there was too little.
template <class T>
void provide(std::unique_ptr<T[]>& array, size_t& capacity, size_t n) {
  if (n <= capacity) return;
  array.reset();
  capacity = 0;
  array = std::make_unique_for_overwrite<T[]>(n);
  capacity = n;
}

}  // namespace

size_t VertexGrid::memory_bytes() const {
  return entry_capacity_ * sizeof(Entry) + start_capacity_ * sizeof(uint32_t);
}

VertexGrid::Plan VertexGrid::start(uint32_t count, float radius, int threads) {
  size_ = 0;
  radius_ = radius;
  cells_.inverse_size = 1 / (2 * double(radius) * kCellScale);
  const size_t buckets = std::max(kMinBuckets, std::bit_ceil(size_t(count)));
  cells_.bucket_mask = uint32_t(buckets - 1);
  provide(entries_, entry_capacity_, count);
  provide(starts_, start_capacity_, buckets + 1);
  const size_t parts = std::clamp<size_t>(buckets / kMinPartBuckets, 1, kMaxParts);
  part_shift_ = std::countr_zero(buckets / parts);
  const uint32_t most = threads <= 1 ? 1 : kBlocksPerThread * uint32_t(threads);
  const uint32_t blocks = std::clamp<uint32_t>(count / kMinBlockSize, 1, most);
  return {count, blocks, uint32_t(parts), std::vector<uint32_t>(blocks * parts)};
}

void VertexGrid::assign_slots(Plan& plan) {
  uint32_t next = 0;
  for (uint32_t part = 0; part < plan.parts; ++part) {
    for (uint32_t block = 0; block < plan.blocks; ++block) {
      uint32_t& slot = plan.row(block)[part];
      const uint32_t count = slot;
      slot = next;
      next += count;
    }
  }
}

void VertexGrid::sort_parts(const Plan& plan, int threads) {
  // The last block's points are the last of each part.
  const uint32_t* const ends = plan.slots.data() + size_t(plan.blocks - 1) * plan.parts;
  starts_[0] = 0;
  parallel_for(plan.parts, threads, [&](size_t part) {
    sort_part(uint32_t(part), part == 0 ? 0 : ends[part - 1], ends[part]);
  });
  size_ = ends[plan.parts - 1];
}

void VertexGrid::sort_part(uint32_t part, uint32_t begin, uint32_t end) {
  const uint32_t first_bucket = part << part_shift_;
  const size_t buckets = size_t(1) << part_shift_;
  // bounds[b] goes from the number of entries of bucket b to its first and then to its end.
  uint32_t* const bounds = starts_.get() + first_bucket + 1;
  std::fill_n(bounds, buckets, 0u);
  // Of each entry first the bucket, then the place to which it moves.
  std::vector<uint32_t> targets(end - begin);
  Entry* const entries = entries_.get() + begin;
  for (size_t i = 0; i < targets.size(); ++i) {
    targets[i] = cells_.bucket(entries[i].position) - first_bucket;
    ++bounds[targets[i]];
  }
  uint32_t next = begin;
  for (size_t b = 0; b < buckets; ++b) {
    const uint32_t count = bounds[b];
    bounds[b] = next;
    next += count;
  }
  for (uint32_t& target : targets) target = bounds[target]++ - begin;
  for (uint32_t i = 0; i < targets.size(); ++i) {
    while (targets[i] != i) {
      const uint32_t target = targets[i];
      std::swap(entries[i], entries[target]);
      targets[i] = targets[target];
      targets[target] = target;
    }
  }
}

namespace {

DUET_WIDEST void find_coordinates(int n, const GridCells& grid, double radius,
                                  const BatchArray<float>& points, BatchArray<uint32_t>& out) {
  const GridCells cells = grid;
  DUET_LANES
  for (int i = 0; i < n; ++i) out[i] = cells.coordinate_in_lanes(double(points[i]) - radius);
}

DUET_WIDEST void find_buckets(int n, const GridCells& grid, const BatchArray<uint32_t>& x,
                              const BatchArray<uint32_t>& y, const BatchArray<uint32_t>& z,
                              BatchArray<uint32_t>& out) {
  const GridCells cells = grid;
  DUET_LANES
  for (int i = 0; i < n; ++i) out[i] = cells.bucket(x[i], y[i], z[i]);
}

}  // namespace

void VertexGrid::locate(int n, const BatchTriples& points, NeighborhoodBatch& around) const {
  BatchArray<uint32_t> lowest[3], next[3];
  const BatchArray<float>* const coordinates[]{&points.x, &points.y, &points.z};
  for (int axis = 0; axis < 3; ++axis) {
    find_coordinates(n, cells_, double(radius_), *coordinates[axis], lowest[axis]);
    for (int i = 0; i < n; ++i) next[axis][i] = lowest[axis][i] + 1;
  }
  for (int k = 0; k < 8; ++k) {
    const auto at = [&](int axis) -> auto& {
      return (k >> axis & 1) ? next[axis] : lowest[axis];
    };
    find_buckets(n, cells_, at(0), at(1), at(2), around[size_t(k)]);
  }
  if (size_ == 0) return;
  for (const BatchArray<uint32_t>& buckets : around)
    for (int i = 0; i < n; ++i) __builtin_prefetch(starts_.get() + buckets[i]);
}

int VertexGrid::select(int count, const BatchTriples& points, const uint32_t* entries,
                       int32_t* numbers, uint32_t* indices) const {
  const float radius_squared = sqr(radius_);
  int found = 0;
  constexpr int kAhead = 16;
  // Without branches: which entries are near cannot be predicted.
  for (int c = 0; c < count; ++c) {
    __builtin_prefetch(&entries_[entries[std::min(c + kAhead, count - 1)]]);
    const Entry& e = entries_[entries[c]];
    const int32_t number = numbers[c];
    numbers[found] = number, indices[found] = e.index;
    found += length_squared(e.position - points.point(number)) < radius_squared;
  }
  return found;
}

}  // namespace duet
