// A tree over lights, or over the triangles of one, from which one is chosen by what it is expected
// to send to a point.
#pragma once

#include <span>
#include <vector>

#include "lights/light_bounds.h"
#include "lights/light_nodes.h"
#include "lights/light_selection.h"

namespace duet {

/// A tree of LightBounds with up to eight children for each node. A way down is chosen among them
/// in proportion to their importance for the point (LightEstimates), down to a leaf or to a node
/// whose lights differ little as seen from there; one of its lights by their power. Every light
/// with power is reached with a probability that is told exactly; of far lights it may be zero, to
/// rounding, so that a share of choices has to be made otherwise.
/// Source: Conty Estevez & Kulla 2018 (light_bounds.h), without their splitting; derivation and
/// differences in docs/lights.md.
class LightTree {
 public:
  /// A node's child is a number of groups(), or the lights of a leaf.
  struct Leaf {
    static constexpr uint32_t kMark = 1u << 31;
    uint32_t first, count;  ///< a range of light_order()

    static bool is(uint32_t child) { return (child & kMark) != 0; }
    static Leaf of(uint32_t child) { return {child >> 3 & (kMost - 1), (child & 7) + 1}; }
    uint32_t child() const { return kMark | first << 3 | (count - 1); }
  };
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
  /// The same for the `n` points of `from` that begin with `first`, at most NodeChoices::kPoints;
  /// `choices.u` are the numbers in [0, 1).
  void sample(const BatchTriples& from, int first, int n, NodeChoices& choices, Pick* picks) const;
  /// The probability with which sample() chooses the light.
  float probability(uint32_t light, const Point3f& from) const;

  bool empty() const { return order_.empty(); }
  size_t memory_bytes() const;
  /// Bounds of everything, where power is the sum.
  const LightBounds& bounds() const { return bounds_; }

  // What it is made of, for tests. The first group is the root's children.
  std::span<const LightNodes> groups() const { return groups_; }
  bool directed() const { return directed_; }
  std::span<const uint32_t> light_order() const { return order_; }
  std::span<const float> powers() const { return powers_; }

 private:
  friend class LightTreeBuilder;
  /// Where a light is.
  struct Place {
    uint32_t position = kNone;  ///< in order_
    uint32_t trail = 0;         ///< three bits for each depth: which node of the group leads to it
  };

  /// A node on the way down.
  struct Step {
    double u;
    float probability;  ///< of the nodes up to this one
    uint32_t child;
    float power;    ///< of what is left to choose from
    bool by_power;  ///< how it is chosen
  };
  static Step step(const LightNodes& group, const NodeChoice& choice, bool even);
  Pick descend(Step step, const Point3f& from) const;

  std::vector<LightNodes> groups_;
  std::vector<uint32_t> order_;  ///< lights, those of a leaf one after the other
  std::vector<float> powers_;    ///< shares of the tree's, by position in order_
  std::vector<Place> places_;    ///< by light
  LightBounds bounds_;
  bool directed_ = false;  ///< whether any light does not shine into all directions
};

/// Whether `count` lights, or triangles of one, are chosen by a tree.
bool needs_tree(size_t count, LightSelection selection);

}  // namespace duet
