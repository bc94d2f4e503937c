#include "volume/nanovdb_tree.h"

#include <nanovdb/NanoVDB.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <type_traits>

namespace duet {

namespace {

using Index = std::array<int64_t, 3>;

/// Copies a tree of one type of values to a dense grid, and looks at every offset before it is
/// followed.
template <class Build>
class DenseCopy {
 public:
  DenseCopy(const NanoVdbBlob& blob, const ByteReader& in) : blob_(blob), in_(in) {}

  void run(VolumeGrid& grid, Index& lower) {
    const auto* tree = at<TreeData>(sizeof(nanovdb::GridData), 0);
    const auto* root = at<RootData>(sizeof(nanovdb::GridData), tree->mNodeOffset[3]);
    const size_t tiles = offset_of(root) + sizeof(RootData);
    if (root->mTableSize > (blob_.size() - tiles) / sizeof(RootTile)) fail();
    set_box(*root, grid);
    lower = lower_;
    std::fill(grid.values.begin(), grid.values.end(), number(root->mBackground));
    std::set<typename RootData::KeyT> copied;
    for (uint32_t i = 0; i < root->mTableSize; ++i) {
      const RootTile& tile = *root->tile(i);
      const auto corner = tile.origin();
      const Index origin{corner[0], corner[1], corner[2]};
      if (Index from, to; !clip(origin, kUpperSize, from, to)) continue;
      // Tiles that are there many times could take for ever.
      if (!copied.insert(tile.key).second) fail();
      if (tile.child == 0)
        fill(origin, kUpperSize, number(tile.value));
      else
        copy_node<UpperData, kLowerSize>(*at<UpperData>(offset_of(root), uint64_t(tile.child)),
                                         origin);
    }
  }

 private:
  using Root = nanovdb::NanoRoot<Build>;
  using RootData = typename Root::DataType;
  using RootTile = typename RootData::Tile;
  using TreeData = nanovdb::TreeData<3>;
  using UpperData = typename nanovdb::NanoUpper<Build>::DataType;
  using LowerData = typename nanovdb::NanoLower<Build>::DataType;
  using LeafData = typename nanovdb::NanoLeaf<Build>::DataType;
  /// Voxels along a side of a node.
  static constexpr int64_t kUpperSize = 4096, kLowerSize = 128, kLeafSize = 8;

  [[noreturn]] void fail() const { in_.fail("has a damaged grid"); }
  size_t offset_of(const void* p) const {
    return size_t(static_cast<const uint8_t*>(p) - blob_.data());
  }
  /// What lies `offset` bytes after (or, by wrapping around, before) `base`.
  template <class T>
  const T* at(uint64_t base, uint64_t offset) const {
    const uint64_t place = base + offset;
    if (place % 32 != 0 || place > blob_.size() || blob_.size() - place < sizeof(T)) fail();
    return reinterpret_cast<const T*>(blob_.data() + place);
  }
  float number(float value) const {
    if (!std::isfinite(value)) in_.fail("has a grid with values that are not finite");
    return value;
  }

  void set_box(const RootData& root, VolumeGrid& grid) {
    double nodes = 1;
    for (int i = 0; i < 3; ++i) {
      const int64_t low = root.mBBox[0][i], high = root.mBBox[1][i];
      if (low > high) in_.fail("has an empty grid");
      lower_[size_t(i)] = low;
      size_[size_t(i)] = high - low + 2;  // with one beyond the last
      nodes *= double(size_[size_t(i)]);
    }
    // Whoever stores so little for so large a box has damaged data, or more than can be made dense.
    constexpr double kMostPerByte = 16, kFew = 1 << 20, kMost = 1e10;
    if (nodes > std::max(kFew, kMostPerByte * double(blob_.size())) || nodes > kMost)
      in_.fail("has a grid of {} x {} x {} voxels, which is too large to be made dense", size_[0],
               size_[1], size_[2]);
    for (size_t i = 0; i < 3; ++i) grid.size[i] = int(size_[i]);
    grid.channels = 1;
    grid.values.resize(grid.node_count());
    values_ = grid.values.data();
  }

  float* voxel(int64_t x, int64_t y, int64_t z) const {
    return values_ + (z * size_[1] + y) * size_[0] + x;
  }
  /// The part of a cube that is in the box, relative to it; whether there is any.
  bool clip(const Index& origin, int64_t side, Index& from, Index& to) const {
    for (size_t i = 0; i < 3; ++i) {
      from[i] = std::max<int64_t>(origin[i] - lower_[i], 0);
      to[i] = std::min(origin[i] - lower_[i] + side, size_[i]);
      if (from[i] >= to[i]) return false;
    }
    return true;
  }
  void fill(const Index& origin, int64_t side, float value) const {
    Index from, to;
    if (!clip(origin, side, from, to)) return;
    for (int64_t z = from[2]; z < to[2]; ++z)
      for (int64_t y = from[1]; y < to[1]; ++y)
        std::fill(voxel(from[0], y, z), voxel(to[0], y, z), value);
  }

  /// An inner node, whose children have `child_side` voxels along a side.
  template <class Data, int64_t child_side>
  void copy_node(const Data& node, const Index& origin) const {
    constexpr uint32_t per_side =
        uint32_t(child_side == kLowerSize ? kUpperSize / kLowerSize : kLowerSize / kLeafSize);
    for (uint32_t n = 0; n < per_side * per_side * per_side; ++n) {
      const Index place{origin[0] + int64_t(n / (per_side * per_side)) * child_side,
                        origin[1] + int64_t(n / per_side % per_side) * child_side,
                        origin[2] + int64_t(n % per_side) * child_side};
      if (Index from, to; !clip(place, child_side, from, to)) continue;
      if (!node.mChildMask.isOn(n)) {
        fill(place, child_side, number(node.mTable[n].value));
        continue;
      }
      const auto offset = uint64_t(node.mTable[n].child);
      if constexpr (child_side == kLowerSize)
        copy_node<LowerData, kLeafSize>(*at<LowerData>(offset_of(&node), offset), place);
      else
        copy_leaf(*at<LeafData>(offset_of(&node), offset), place);
    }
  }

  void copy_leaf(const LeafData& leaf, const Index& origin) const {
    if constexpr (std::is_same_v<Build, nanovdb::FpN>) {
      // Codes of a number of bits that differs from leaf to leaf follow it.
      if (leaf.bitWidth() > 16 || blob_.size() - offset_of(&leaf) < leaf.memUsage()) fail();
    }
    Index from, to;
    if (!clip(origin, kLeafSize, from, to)) return;
    for (int64_t z = from[2]; z < to[2]; ++z)
      for (int64_t y = from[1]; y < to[1]; ++y)
        for (int64_t x = from[0]; x < to[0]; ++x) {
          const auto i = [&](int64_t v, size_t axis) {
            return uint32_t(v + lower_[axis] - origin[axis]);
          };
          *voxel(x, y, z) = number(leaf.getValue(i(x, 0) << 6 | i(y, 1) << 3 | i(z, 2)));
        }
  }

  const NanoVdbBlob& blob_;
  const ByteReader& in_;
  Index lower_{}, size_{};
  float* values_ = nullptr;
};

/// From the unit cube over the nodes to the file's space.
Matrix4 placement(const nanovdb::Map& map, const Index& lower, const std::array<int, 3>& size,
                  const ByteReader& in) {
  Matrix4 to_world;
  for (size_t r = 0; r < 3; ++r) {
    double offset = map.mVecD[r];
    for (size_t c = 0; c < 3; ++c) {
      const double m = map.mMatD[3 * r + c];
      offset += m * double(lower[c]);
      to_world.m[r][c] = m * double(size[c] - 1);
      if (!std::isfinite(m)) in.fail("has a damaged grid");
    }
    to_world.m[r][3] = offset;
    if (!std::isfinite(offset)) in.fail("has a damaged grid");
  }
  return to_world;
}

}  // namespace

NanoVdbGrid dense_nanovdb_grid(const NanoVdbBlob& blob, const ByteReader& in) {
  if (blob.size() < sizeof(nanovdb::GridData) + sizeof(nanovdb::TreeData<3>))
    in.fail("has a damaged grid");
  const auto& data = *reinterpret_cast<const nanovdb::GridData*>(blob.data());
  NanoVdbGrid result;
  Index lower{};
  switch (data.mGridType) {
    case nanovdb::GridType::Float:
      DenseCopy<float>(blob, in).run(result.grid, lower);
      break;
    case nanovdb::GridType::Fp4:
      DenseCopy<nanovdb::Fp4>(blob, in).run(result.grid, lower);
      break;
    case nanovdb::GridType::Fp8:
      DenseCopy<nanovdb::Fp8>(blob, in).run(result.grid, lower);
      break;
    case nanovdb::GridType::Fp16:
      DenseCopy<nanovdb::Fp16>(blob, in).run(result.grid, lower);
      break;
    case nanovdb::GridType::FpN:
      DenseCopy<nanovdb::FpN>(blob, in).run(result.grid, lower);
      break;
    default:
      in.fail("has a grid of type {}; only floats and quantised floats can be read",
              uint32_t(data.mGridType));
  }
  result.to_world = placement(data.mMap, lower, result.grid.size, in);
  return result;
}

}  // namespace duet
