#include "lights/light_nodes.h"

#include <algorithm>
#include <cmath>

#include "base/instruction_sets.h"
#include "math/warp.h"

namespace duet {

namespace {

/// Of a distance: keeps the importance finite.
constexpr float kLeastSquare = 1e-30f;

}  // namespace

void LightNodes::set(int i, const LightNode& node) {
  x[i] = node.center.x, y[i] = node.center.y, z[i] = node.center.z;
  radius[i] = node.radius;
  power[i] = node.power;
  intensity[i] = node.intensity;
  child[i] = node.child;
  axis_x[i] = node.axis.x, axis_y[i] = node.axis.y, axis_z[i] = node.axis.z;
  normals[i] = node.normals;
  spread[i] = node.spread;
}

// The loops are without branches, so that all eight nodes, or many points, are looked at together.

namespace {

/// What LightEstimates have of a node.
struct NodeEstimate {
  float importance;
  int32_t even;
};

[[gnu::always_inline]] inline NodeEstimate estimate_undirected(const LightNode& node,
                                                               const Point3f& from) {
  const float vx = from.x - node.center.x, vy = from.y - node.center.y, vz = from.z - node.center.z;
  const float radius = node.radius;
  const float d2 = std::max(vx * vx + vy * vy + vz * vz, kLeastSquare), d = std::sqrt(d2);
  const float near = d - radius, far = d + radius;
  const float spare = LightEstimates::kEven * near * near - far * far;
  return {node.intensity / std::max(d2, radius * radius), std::min(spare, near) > 0 ? 1 : 0};
}

[[gnu::always_inline]] inline NodeEstimate estimate_directed(const LightNode& node,
                                                             const Point3f& from) {
  const float vx = from.x - node.center.x, vy = from.y - node.center.y, vz = from.z - node.center.z;
  const float radius = node.radius;
  const float d2 = std::max(vx * vx + vy * vy + vz * vz, kLeastSquare);
  const float flux = node.intensity / std::max(d2, radius * radius);
  const float inverse = 1 / std::sqrt(d2);
  const float cosine = (node.axis.x * vx + node.axis.y * vy + node.axis.z * vz) * inverse;
  // θ_o and the angle under which the sphere is seen, θ_u.
  const float cos_o = node.normals, sin_o = std::sqrt(std::max(1 - cos_o * cos_o, 0.0f));
  const float sin_u = std::min(radius * inverse, 1.0f);
  const float cos_u = std::sqrt(std::max(1 - sin_u * sin_u, 0.0f));
  const float cos_both = cos_o * cos_u - sin_o * sin_u;
  const float sin_both = sin_o * cos_u + cos_o * sin_u;
  // Above zero among the lights, where they shine into all directions, and where the sum is above
  // π: angles say nothing there.
  const float open = std::max(std::max(sin_u - kBelowOne, -kBelowOne - cos_o), -sin_both);
  const float sine = std::sqrt(std::max(1 - cosine * cosine, 0.0f));
  const float along = cosine * cos_both, across = sine * sin_both;
  const float bound = std::max(node.spread, 0.0f);
  const float beyond = along + across > bound ? along + across : 0.0f;
  const float nearest = cosine >= cos_both ? 1.0f : beyond, furthest = along - across;
  // (d − r)² and (d + r)², over d².
  const float near = (1 - sin_u) * (1 - sin_u), far = (1 + sin_u) * (1 + sin_u);
  const float spare = LightEstimates::kEven * furthest * near - nearest * far;
  // Above zero where the furthest angle is below π, from where on its cosine grows again.
  const float turned = sine * cos_both + cosine * sin_both;
  const float least = std::min(std::min(spare, furthest - bound), std::min(turned, -open));
  return {flux * (open > 0 ? 1.0f : nearest), least > 0 ? 1 : 0};
}

}  // namespace

static DUET_WIDE void estimate_undirected(const LightNodes& nodes, const Point3f& from,
                                          LightEstimates& estimates) {
  const Point3f p = from;
  DUET_LANES
  for (int i = 0; i < LightNodes::kCount; ++i) {
    const NodeEstimate e = estimate_undirected(nodes.get(i), p);
    estimates.importance[i] = e.importance;
    estimates.even[i] = e.even;
  }
}

static DUET_WIDE void estimate_directed(const LightNodes& nodes, const Point3f& from,
                                        LightEstimates& estimates) {
  const Point3f p = from;
  DUET_LANES
  for (int i = 0; i < LightNodes::kCount; ++i) {
    const NodeEstimate e = estimate_directed(nodes.get(i), p);
    estimates.importance[i] = e.importance;
    estimates.even[i] = e.even;
  }
}

void estimate(const LightNodes& nodes, bool directed, const Point3f& from,
              LightEstimates& estimates) {
  if (directed)
    estimate_directed(nodes, from, estimates);
  else
    estimate_undirected(nodes, from, estimates);
  if (estimates.add_up()) return;
  std::copy_n(nodes.intensity, LightNodes::kCount, estimates.importance);
  estimates.add_up();
}

bool LightEstimates::add_up() {
  float sum = 0;
  for (int i = 0; i < LightNodes::kCount; ++i) sums[i] = sum += importance[i];
  return sum > 0;
}

/// Times a number it is below that number, whatever rounding does.
constexpr double kLargestVariate = 1 - 0x1p-52;

NodeChoice LightEstimates::choose(double u) const {
  // Without branches, which would be hard to predict.
  const double target = std::min(u, kLargestVariate) * double(sums[LightNodes::kCount - 1]);
  int chosen = 0;
  for (int i = 0; i < LightNodes::kCount - 1; ++i) chosen += target >= double(sums[i]);
  const double before = chosen > 0 ? double(sums[chosen - 1]) : 0;
  return {chosen, std::min((target - before) / double(importance[chosen]), kLargestVariate),
          share(chosen)};
}

namespace {

using PointNumbers = float[NodeChoices::kPoints];

/// LightEstimates of several points, by node.
struct alignas(64) PointEstimates {
  PointNumbers importance[LightNodes::kCount];
  PointNumbers sums[LightNodes::kCount];
  int32_t even[LightNodes::kCount][NodeChoices::kPoints];
};

template <bool kDirected>
[[gnu::always_inline]] inline void estimate_node(const LightNode& node, const BatchTriples& from,
                                                 int first, int n, float* importance,
                                                 int32_t* even) {
  const LightNode l = node;
  DUET_LANES
  for (int i = 0; i < n; ++i) {
    const Point3f p = from.point(first + i);
    const NodeEstimate e = kDirected ? estimate_directed(l, p) : estimate_undirected(l, p);
    importance[i] = e.importance;
    even[i] = e.even;
  }
}

DUET_WIDEST void estimate_undirected_node(const LightNode& node, const BatchTriples& from,
                                          int first, int n, float* importance, int32_t* even) {
  estimate_node<false>(node, from, first, n, importance, even);
}

DUET_WIDEST void estimate_directed_node(const LightNode& node, const BatchTriples& from, int first,
                                        int n, float* importance, int32_t* even) {
  estimate_node<true>(node, from, first, n, importance, even);
}

/// Adds up what is known of `count` nodes, of which the intensities stand in where all are zero.
DUET_WIDEST void add_up(const LightNodes& nodes, int count, int n, PointEstimates& estimates) {
  PointNumbers known{}, sums{};
  for (int k = 0; k < count; ++k) {
    const float* const importance = estimates.importance[k];
    DUET_LANES
    for (int i = 0; i < n; ++i) known[i] += importance[i];
  }
  for (int k = 0; k < count; ++k) {
    float* const importance = estimates.importance[k];
    float* const sums_here = estimates.sums[k];
    const float intensity = nodes.intensity[k];
    DUET_LANES
    for (int i = 0; i < n; ++i) {
      importance[i] = known[i] > 0 ? importance[i] : intensity;
      sums_here[i] = sums[i] += importance[i];
    }
  }
}

/// How many of the sums are not above a number, and the last of these.
struct Passed {
  double count[NodeChoices::kPoints], sum[NodeChoices::kPoints];
};

DUET_WIDEST void find_passed(const PointEstimates& estimates, int count, int n,
                             const double* targets, Passed& passed) {
  for (int k = 0; k + 1 < count; ++k) {
    const float* const sums = estimates.sums[k];
    DUET_LANES
    for (int i = 0; i < n; ++i) {
      const double sum = double(sums[i]);
      passed.count[i] += targets[i] >= sum ? 1.0 : 0.0;
      passed.sum[i] = targets[i] >= sum ? sum : passed.sum[i];
    }
  }
}

/// LightEstimates::choose() among `count` nodes.
void choose(const PointEstimates& estimates, int count, int n, NodeChoices& choices) {
  const float* const all = estimates.sums[count - 1];
  double targets[NodeChoices::kPoints];
  for (int i = 0; i < n; ++i) targets[i] = std::min(choices.u[i], kLargestVariate) * double(all[i]);
  Passed passed{};
  find_passed(estimates, count, n, targets, passed);
  for (int i = 0; i < n; ++i) {
    const int node = int(passed.count[i]);
    const float own = estimates.importance[node][i];
    choices.node[i] = node;
    choices.u[i] = std::min((targets[i] - passed.sum[i]) / double(own), kLargestVariate);
    choices.probability[i] = own / all[i];
    choices.even[i] = estimates.even[node][i];
  }
}

}  // namespace

void choose_nodes(const LightNodes& nodes, bool directed, const BatchTriples& from, int first,
                  int n, NodeChoices& choices) {
  PointEstimates estimates;
  int count = LightNodes::kCount;
  while (count > 1 && !(nodes.power[count - 1] > 0)) --count;
  for (int k = 0; k < count; ++k)
    (directed ? estimate_directed_node : estimate_undirected_node)(
        nodes.get(k), from, first, n, estimates.importance[k], estimates.even[k]);
  add_up(nodes, count, n, estimates);
  choose(estimates, count, n, choices);
}

}  // namespace duet
