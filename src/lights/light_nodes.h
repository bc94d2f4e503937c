// The nodes of a light tree: what bounds of lights tell about what they send to a point.
#pragma once

#include <cstdint>

#include "math/batch.h"

namespace duet {

/// A cluster of lights.
struct LightNode {
  Point3f center;  ///< of a sphere that holds the lights
  float radius = 0;
  float power = 0;      ///< share of the tree's
  float intensity = 0;  ///< that over LightBounds::measure()
  uint32_t child = 0;   ///< see LightTree
  Vector3f axis;        ///< unit length, of the cone of normals
  float normals = 1;    ///< cosine of the cone's angle, −1 if it holds all directions
  float spread = 0;     ///< cosine of LightBounds::spread
};

/// Up to eight siblings, to be looked at together. Where there is no node, its power and intensity
/// are zero.
struct alignas(64) LightNodes {
  static constexpr int kCount = 8;
  float x[kCount], y[kCount], z[kCount], radius[kCount];
  float power[kCount], intensity[kCount];
  uint32_t child[kCount];
  float axis_x[kCount], axis_y[kCount], axis_z[kCount];
  float normals[kCount], spread[kCount];

  void set(int i, const LightNode& node);
  [[gnu::always_inline]] LightNode get(int i) const {
    return {{x[i], y[i], z[i]}, radius[i], power[i],
            intensity[i],       child[i],  {axis_x[i], axis_y[i], axis_z[i]},
            normals[i],         spread[i]};
  }
};

/// One of LightNodes, chosen in proportion to its importance.
struct NodeChoice {
  int node;
  double u;  ///< uniform in [0, 1) again
  float probability;
};

/// What lights are expected to send to a point, for each of LightNodes.
struct LightEstimates {
  /// Up to a factor that is common to all nodes of a tree. Not all are zero, but for those of no
  /// node at all: where all would be, they are the intensities.
  float importance[LightNodes::kCount];
  float sums[LightNodes::kCount];  ///< of the importance up to and with this node
  /// Not zero if lights of equal intensity differ by no more than kEven in what they send there,
  /// wherever within the node's bounds they are.
  int32_t even[LightNodes::kCount];

  static constexpr float kEven = 4;

  /// Sets `sums`. Whether they are above zero.
  bool add_up();
  /// The probability of a node.
  float share(int i) const { return importance[i] / sums[LightNodes::kCount - 1]; }
  /// `u` in [0, 1).
  NodeChoice choose(double u) const;
};

/// `directed` is false if all lights of the tree shine into all directions.
/// Source: Conty Estevez & Kulla 2018 (light_bounds.h), section 4.3; docs/lights.md.
void estimate(const LightNodes& nodes, bool directed, const Point3f& from,
              LightEstimates& estimates);

/// Choices among the same nodes for several points, with the bits of LightEstimates.
struct NodeChoices {
  /// So few that all numbers are in the nearest cache.
  static constexpr int kPoints = 64;
  double u[kPoints];  ///< set by the caller, in [0, 1), and remapped; else as in NodeChoice
  int32_t node[kPoints];
  float probability[kPoints];
  int32_t even[kPoints];  ///< of the chosen node; see LightEstimates
};

/// Chooses for the `n` points of `from` that begin with `first`; at most NodeChoices::kPoints.
void choose_nodes(const LightNodes& nodes, bool directed, const BatchTriples& from, int first,
                  int n, NodeChoices& choices);

}  // namespace duet
