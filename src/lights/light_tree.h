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
    float power;     ///< its share of the tree's
  };
  /// `u` in [0, 1). The tree must not be empty.
  Pick sample(double u, const Point3f& from) const;
  /// The same for the `n` points of `from` that begin with `first`, at most NodeChoices::kPoints;
  /// `choices.u` are the numbers in [0, 1).
  void sample(const BatchTriples& from, int first, int n, NodeChoices& choices, Pick* picks) const;
  struct Query {
    const LightTree* tree;
    double u;  ///< in [0, 1)
    Point3f from;
  };
  /// Picks of the trees, side by side, so that the processor waits for the memory of all at once.
  static void sample(std::span<const Query> queries, Pick* picks);
  /// The probability with which sample() chooses the light.
  float probability(uint32_t light, const Point3f& from) const;
  /// Its share of the tree's power, 0 if it is not in the tree.
  float power(uint32_t light) const {
    const uint32_t position = places_[light].position;
    return position == kNone ? 0 : powers_[position];
  }

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
    /// Uniform in [0, 1); times the power once the rest of the way goes by that.
    double u;
    float probability;  ///< of the nodes up to this one
    uint32_t child;
    float power;    ///< of the last node that was not chosen by power
    bool by_power;  ///< how what is below is chosen

    bool ends() const { return by_power && Leaf::is(child); }
  };
  /// One of several ways down.
  struct Way {
    const LightTree* tree;
    Point3f from;
    Step step;
  };
  static Step step(const LightNodes& group, const NodeChoice& choice, bool even);
  Step first_step(double u, const Point3f& from) const;
  /// From a step that does not end.
  Step next(const Step& s, const Point3f& from) const;
  static uint32_t choose_by_power(const LightNodes& group, double& u);
  Pick finish(const Step& s) const;
  void prefetch(const Step& s) const;
  /// At most NodeChoices::kPoints ways.
  static void descend(std::span<Way> ways, Pick* picks);

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
