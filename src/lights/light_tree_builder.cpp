// Builds light trees from the top: each cluster is split where the two halves tell most.
#include <array>
#include <bit>
#include <cassert>

#include "lights/light_tree.h"

namespace duet {

namespace {

constexpr int kBins = 12;
constexpr uint32_t kChildren = LightNodes::kCount;
constexpr uint32_t kChildBits = std::bit_width(kChildren - 1);
/// As many groups as a trail has room for.
constexpr uint32_t kMostDepth = 32 / kChildBits;

/// Of a cluster with more lights than this only the longest axis is looked at.
constexpr uint32_t kLargeCluster = 1024;

/// Bounds, in the loops over all lights.
struct Box {
  Point3f lower{INFINITY}, upper{-INFINITY};
  void extend(const Point3f& l, const Point3f& u) {
    lower = {std::min(lower.x, l.x), std::min(lower.y, l.y), std::min(lower.z, l.z)};
    upper = {std::max(upper.x, u.x), std::max(upper.y, u.y), std::max(upper.z, u.z)};
  }
  Vector3f size() const { return upper - lower; }
  int longest_axis() const {
    const Vector3f s = size();
    return s.x >= s.y && s.x >= s.z ? 0 : s.y >= s.z ? 1 : 2;
  }
};

/// Twice the centre of a light's bounds.
Point3f doubled_center(const LightBounds& b) {
  return b.box.lower + Vector3f(b.box.upper);
}

/// The lights whose centres lie in one slice of a cluster.
struct Bin {
  Box box;
  Vector3f axis{};  ///< sum of mean directions, weighted with power
  float power = 0;
  uint32_t count = 0;

  void add(const LightBounds& b) {
    // The mean of directions that fill a cone evenly is (1 + cos θ_o) / 2 times as long as they.
    const float mean = b.normals.angle > 0 ? 0.5f * (1 + std::cos(b.normals.angle)) : 1.0f;
    box.extend(b.box.lower, b.box.upper);
    axis += b.normals.axis * (b.power * mean);
    power += b.power;
    ++count;
  }
  void add(const Bin& b) {
    box.extend(b.box.lower, b.box.upper);
    axis += b.axis;
    power += b.power;
    count += b.count;
  }
  /// How badly its bounds represent it: power · diagonal² · M_Ω / π. M_Ω, the integral of the
  /// cosine bound over all directions, is π for parallel normals and 4π for all directions; taken
  /// to be linear in the length of the mean normal between the two.
  float cost() const {
    const float mean = power > 0 ? std::min(length(axis) / power, 1.0f) : 0.0f;
    return count == 0 ? 0 : power * length_squared(box.size()) * (4 - 3 * mean);
  }
};

struct Split {
  int axis = -1;  ///< or -1: nothing tells the lights apart
  int bin = 0;    ///< the first of the second half
  float cost = INFINITY;
};

/// The least share of a light in the power: what is made of it is far from where numbers lose
/// digits.
constexpr float kLeastShare = 1e-30f;

/// A node of the lights with these bounds, whose power is their share of the tree's.
LightNode make_node(const LightBounds& b, uint32_t child) {
  LightNode n;
  n.center = b.box.center();
  n.radius = b.box.radius();
  n.power = b.power;
  // Narrow beams shall not let the importance overflow.
  n.intensity = n.power / std::max(b.measure(), 1e-3f);
  n.child = child;
  n.axis = b.normals.axis;
  n.normals = std::cos(b.normals.angle);
  n.spread = std::cos(b.spread);
  return n;
}

}  // namespace

class LightTreeBuilder {
 public:
  LightTreeBuilder(LightTree& tree, std::vector<LightTree::Entry> items, uint32_t leaf_size)
      : tree_(tree), leaf_size_(leaf_size), items_(std::move(items)) {
    for (const Item& item : items_) total_ += double(item.bounds.power);
    for (Item& item : items_)
      item.bounds.power = std::max(float(double(item.bounds.power) / total_), kLeastShare);
    tree_.order_.reserve(items_.size());
    tree_.powers_.reserve(items_.size());
  }

  void build() {
    if (items_.empty()) return;
    group({0, uint32_t(items_.size())}, 0, 0, tree_.bounds_);
    tree_.bounds_.power = float(total_);
  }

 private:
  using Item = LightTree::Entry;
  /// Cuts a cluster into slices across an axis.
  class Slices {
   public:
    Slices(const Box& centers, int axis)
        : axis_(axis), lower_(centers.lower[axis]), scale_(kBins / centers.size()[axis]) {}
    int operator()(const LightBounds& b) const {
      return std::clamp(int((doubled_center(b)[axis_] - lower_) * scale_), 0, kBins - 1);
    }

   private:
    int axis_;
    float lower_, scale_;
  };
  struct Range {
    uint32_t begin, end;
    uint32_t size() const { return end - begin; }
  };

  /// Makes the children of a node of a range of items; returns the number of the group, and
  /// extends `bounds` by all of them.
  uint32_t group(const Range& range, uint32_t depth, uint32_t trail, LightBounds& bounds) {
    const uint32_t number = uint32_t(tree_.groups_.size());
    tree_.groups_.emplace_back();
    uint32_t i = 0;
    for (const Range& part : parts(range, depth)) {
      if (part.size() == 0) continue;
      const uint32_t way = trail | i << (kChildBits * depth);
      LightBounds b;
      const uint32_t child =
          part.size() <= leaf_size_ ? leaf(part, way, b) : group(part, depth + 1, way, b);
      tree_.groups_[number].set(int(i++), make_node(b, child));
      bounds.extend(b);
    }
    return number;
  }

  /// Divides the largest part again and again, until there are kChildren or all are leaves. Those
  /// that are not used are empty.
  std::array<Range, kChildren> parts(const Range& range, uint32_t depth) {
    // Parts of equal number from where on worse ones might need more bits than a trail has.
    const uint32_t bits = uint32_t(std::bit_width(range.size() - 1));
    const bool must_halve = depth + (bits + kChildBits - 1) / kChildBits >= kMostDepth;
    std::array<Range, kChildren> parts{range};
    for (uint32_t n = 1; n < kChildren; ++n) {
      Range& largest =
          *std::max_element(parts.begin(), parts.begin() + n,
                            [](const Range& a, const Range& b) { return a.size() < b.size(); });
      if (largest.size() <= leaf_size_) break;
      const uint32_t middle = divide(largest, must_halve);
      parts[n] = {middle, largest.end};
      largest.end = middle;
    }
    return parts;
  }

  uint32_t leaf(const Range& range, uint32_t trail, LightBounds& bounds) {
    const uint32_t first = uint32_t(tree_.order_.size());
    for (uint32_t i = range.begin; i < range.end; ++i) {
      const Item& item = items_[i];
      bounds.extend(item.bounds);
      tree_.directed_ |= item.bounds.normals.angle < kPi;
      tree_.places_[item.light] = {uint32_t(tree_.order_.size()), trail};
      tree_.order_.push_back(item.light);
      tree_.powers_.push_back(item.bounds.power);
    }
    return LightTree::Leaf{first, range.size()}.child();
  }

  /// Puts the items of the first half before the others; returns where the second one begins.
  uint32_t divide(const Range& range, bool must_halve) {
    Box centers;
    for (uint32_t i = range.begin; i < range.end; ++i) {
      const Point3f c = doubled_center(items_[i].bounds);
      centers.extend(c, c);
    }
    const Split split = must_halve ? Split{} : find_split(range, centers);
    const auto begin = items_.begin() + range.begin, end = items_.begin() + range.end;
    if (split.axis >= 0) {
      const Slices slice(centers, split.axis);
      const auto middle = std::partition(begin, end, [slice, bin = split.bin](const Item& item) {
        return slice(item.bounds) < bin;
      });
      return uint32_t(middle - items_.begin());
    }
    const int axis = centers.longest_axis();
    const uint32_t middle = range.begin + range.size() / 2;
    std::nth_element(begin, items_.begin() + middle, end, [axis](const Item& a, const Item& b) {
      const float x = doubled_center(a.bounds)[axis], y = doubled_center(b.bounds)[axis];
      return x != y ? x < y : a.light < b.light;
    });
    return middle;
  }

  Split find_split(const Range& range, const Box& centers) const {
    Split best;
    const int longest = centers.longest_axis();
    for (int axis = 0; axis < 3; ++axis) {
      if (axis != longest && range.size() > kLargeCluster) continue;
      const float scale = kBins / centers.size()[axis];
      if (!(scale > 0) || !std::isfinite(scale)) continue;
      const Slices slice(centers, axis);
      std::array<Bin, kBins> bins;
      for (uint32_t i = range.begin; i < range.end; ++i)
        bins[size_t(slice(items_[i].bounds))].add(items_[i].bounds);
      look_for_split(bins, axis, best);
    }
    return best;
  }

  static void look_for_split(const std::array<Bin, kBins>& bins, int axis, Split& best) {
    std::array<float, kBins> second{};
    Bin sum;
    for (size_t i = kBins; i-- > 1;) {
      sum.add(bins[i]);
      second[i] = sum.count > 0 ? sum.cost() : INFINITY;
    }
    sum = {};
    for (size_t i = 1; i < kBins; ++i) {
      sum.add(bins[i - 1]);
      const float cost = sum.cost() + second[i];
      if (sum.count > 0 && cost < best.cost) best = {axis, int(i), cost};
    }
  }

  LightTree& tree_;
  uint32_t leaf_size_;
  std::vector<Item> items_;
  double total_ = 0;
};

LightTree::LightTree(std::vector<Entry> entries, uint32_t count, uint32_t leaf_size)
    : places_(count) {
  assert(entries.size() <= kMost && leaf_size >= 1 && leaf_size <= kMostInLeaf);
  LightTreeBuilder(*this, std::move(entries), leaf_size).build();
  groups_.shrink_to_fit();
}

}  // namespace duet
