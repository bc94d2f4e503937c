// A tree over lights, or over the triangles of one, from which one is chosen by what it is expected
// to send to a point.
#pragma once

#include <span>
#include <vector>

#include "lights/light_bounds.h"
#include "lights/light_selection.h"

namespace duet {

/// A binary tree of LightBounds. A way down is chosen at each pair of nodes in proportion to their
/// importance() for the point; the lights of a leaf by their power. Every light with power is
/// reached with a probability that is told exactly; of far lights it may be zero, to rounding, so
/// that a share of choices has to be made otherwise.
/// Source: Conty Estevez & Kulla 2018 (light_bounds.h), without their splitting; derivation and
/// differences in docs/lights.md.
class LightTree {
 public:
  /// A node is half a cache line; beside it in memory is its sibling.
  struct Node {
    Point3f center;  ///< of a sphere that holds the lights
    float radius;
    float intensity;  ///< share of the tree's power over LightBounds::measure()
    uint32_t child;   ///< number of a pair, or the lights of a leaf
    int16_t axis[3];  ///< of the cone of normals, times 32767
    int8_t normals;   ///< cosine of the cone's angle, times 127 and rounded down
    int8_t spread;    ///< the same of LightBounds::spread

    bool is_leaf() const { return (child & kLeaf) != 0; }
    /// Of a leaf: the range in light_order().
    uint32_t first() const { return child >> 3 & (kMost - 1); }
    uint32_t count() const { return (child & 7) + 1; }
    /// What the lights are expected to send to `from`, up to a factor that is common to all nodes.
    float importance(const Point3f& from) const;
  };
  struct alignas(64) Pair {
    Node nodes[2];
    /// The probability of the first node.
    float first_share(const Point3f& from) const;
  };
  static constexpr uint32_t kLeaf = 1u << 31;
  static constexpr uint32_t kMost = 1u << 28;  ///< lights
  static constexpr uint32_t kMostInLeaf = 8;

  struct Entry {
    LightBounds bounds;  ///< with power
    uint32_t light;      ///< its number
  };
  /// Over the entries, at most kMost; numbers of lights are below `count`. A leaf holds up to
  /// `leaf_size` lights, which must not be above kMostInLeaf.
  LightTree(std::vector<Entry> entries, uint32_t count, uint32_t leaf_size);

  struct Pick {
    uint32_t light;
    float probability;
    float remapped;  ///< uniform in [0, 1) again, independent of the light
  };
  /// `u` in [0, 1). The tree must not be empty.
  Pick sample(double u, const Point3f& from) const;
  /// The probability with which sample() chooses the light.
  float probability(uint32_t light, const Point3f& from) const;

  bool empty() const { return order_.empty(); }
  size_t memory_bytes() const;
  /// Bounds of everything, where power is the sum.
  const LightBounds& bounds() const { return bounds_; }

  // What it is made of, for tests.
  std::span<const Pair> pairs() const { return pairs_; }
  std::span<const uint32_t> light_order() const { return order_; }
  std::span<const float> powers() const { return powers_; }

 private:
  friend class LightTreeBuilder;
  /// Where a light is.
  struct Place {
    uint32_t position = kNone;  ///< in order_
    uint32_t trail = 0;         ///< bit i: which node of the pair at depth i leads to it
  };
  float leaf_power(const Node& leaf) const;

  std::vector<Pair> pairs_;
  Node root_{};
  std::vector<uint32_t> order_;  ///< lights, those of a leaf one after the other
  std::vector<float> powers_;    ///< by position in order_
  std::vector<Place> places_;    ///< by light
  LightBounds bounds_;
};

/// Whether `count` lights, or triangles of one, are chosen by a tree.
bool needs_tree(size_t count, LightSelection selection);

}  // namespace duet
