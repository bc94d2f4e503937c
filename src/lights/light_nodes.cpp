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

LightNode LightNodes::get(int i) const {
  return {{x[i], y[i], z[i]}, radius[i], power[i],
          intensity[i],       child[i],  {axis_x[i], axis_y[i], axis_z[i]},
          normals[i],         spread[i]};
}

// The loops are without branches, so that all eight nodes are looked at together.

static DUET_WIDE void estimate_undirected(const LightNodes& nodes, const Point3f& from,
                                          LightEstimates& estimates) {
  const float px = from.x, py = from.y, pz = from.z;
  DUET_LANES
  for (int i = 0; i < LightNodes::kCount; ++i) {
    const float vx = px - nodes.x[i], vy = py - nodes.y[i], vz = pz - nodes.z[i];
    const float radius = nodes.radius[i];
    const float d2 = std::max(vx * vx + vy * vy + vz * vz, kLeastSquare), d = std::sqrt(d2);
    estimates.importance[i] = nodes.intensity[i] / std::max(d2, radius * radius);
    const float near = d - radius, far = d + radius;
    const float spare = LightEstimates::kEven * near * near - far * far;
    estimates.even[i] = std::min(spare, near) > 0 ? 1 : 0;
  }
}

static DUET_WIDE void estimate_directed(const LightNodes& nodes, const Point3f& from,
                                        LightEstimates& estimates) {
  const float px = from.x, py = from.y, pz = from.z;
  DUET_LANES
  for (int i = 0; i < LightNodes::kCount; ++i) {
    const float vx = px - nodes.x[i], vy = py - nodes.y[i], vz = pz - nodes.z[i];
    const float radius = nodes.radius[i];
    const float d2 = std::max(vx * vx + vy * vy + vz * vz, kLeastSquare);
    const float flux = nodes.intensity[i] / std::max(d2, radius * radius);
    const float inverse = 1 / std::sqrt(d2);
    const float cosine =
        (nodes.axis_x[i] * vx + nodes.axis_y[i] * vy + nodes.axis_z[i] * vz) * inverse;
    // θ_o and the angle under which the sphere is seen, θ_u.
    const float cos_o = nodes.normals[i], sin_o = std::sqrt(std::max(1 - cos_o * cos_o, 0.0f));
    const float sin_u = std::min(radius * inverse, 1.0f);
    const float cos_u = std::sqrt(std::max(1 - sin_u * sin_u, 0.0f));
    const float cos_both = cos_o * cos_u - sin_o * sin_u;
    const float sin_both = sin_o * cos_u + cos_o * sin_u;
    // Above zero among the lights, where they shine into all directions, and where the sum is above
    // π: angles say nothing there.
    const float open = std::max(std::max(sin_u - kBelowOne, -kBelowOne - cos_o), -sin_both);
    const float sine = std::sqrt(std::max(1 - cosine * cosine, 0.0f));
    const float along = cosine * cos_both, across = sine * sin_both;
    const float bound = std::max(nodes.spread[i], 0.0f);
    const float beyond = along + across > bound ? along + across : 0.0f;
    const float nearest = cosine >= cos_both ? 1.0f : beyond, furthest = along - across;
    estimates.importance[i] = flux * (open > 0 ? 1.0f : nearest);
    // (d − r)² and (d + r)², over d².
    const float near = (1 - sin_u) * (1 - sin_u), far = (1 + sin_u) * (1 + sin_u);
    const float spare = LightEstimates::kEven * furthest * near - nearest * far;
    // Above zero where the furthest angle is below π, from where on its cosine grows again.
    const float turned = sine * cos_both + cosine * sin_both;
    const float least = std::min(std::min(spare, furthest - bound), std::min(turned, -open));
    estimates.even[i] = least > 0 ? 1 : 0;
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

}  // namespace duet
