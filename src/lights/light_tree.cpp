#include "lights/light_tree.h"

#include <limits>

#include "math/warp.h"

namespace duet {

float LightTree::Node::importance(const Point3f& from) const {
  const Vector3f v = from - center;
  const float d2 = length_squared(v), r2 = radius * radius;
  const float flux = intensity / std::max({d2, r2, std::numeric_limits<float>::min()});
  // Among the lights, or where they shine into all directions, angles say nothing.
  if (normals == -127 || !(d2 > r2)) return flux;
  const float inverse = 1 / std::sqrt(d2);
  const float cosine = (float(axis[0]) * v.x + float(axis[1]) * v.y + float(axis[2]) * v.z) *
                       (inverse * (1 / 32767.0f));
  // θ_o and the angle under which the sphere is seen, θ_u.
  const float cos_o = float(normals) * (1 / 127.0f), sin_o = safe_sqrt(1 - cos_o * cos_o);
  const float sin_u = radius * inverse, cos_u = safe_sqrt(1 - sin_u * sin_u);
  const float cos_both = cos_o * cos_u - sin_o * sin_u, sin_both = sin_o * cos_u + cos_o * sin_u;
  // A sine below zero: the sum is above π.
  if (sin_both < 0 || cosine >= cos_both) return flux;
  const float nearest = cosine * cos_both + safe_sqrt(1 - cosine * cosine) * sin_both;
  return nearest > float(spread) * (1 / 127.0f) ? flux * std::max(nearest, 0.0f) : 0.0f;
}

float LightTree::Pair::first_share(const Point3f& from) const {
  const float a = nodes[0].importance(from), b = nodes[1].importance(from);
  const float sum = a + b;
  return sum > 0 ? a / sum : nodes[0].intensity / (nodes[0].intensity + nodes[1].intensity);
}

float LightTree::leaf_power(const Node& leaf) const {
  float sum = 0;
  for (uint32_t i = 0; i < leaf.count(); ++i) sum += powers_[leaf.first() + i];
  return sum;
}

LightTree::Pick LightTree::sample(double u, const Point3f& from) const {
  const Node* node = &root_;
  float probability = 1;
  const auto keep = [&](double rest, float p) {
    u = std::min(rest / double(p), 1 - 0x1p-53);
    probability *= p;
  };
  while (!node->is_leaf()) {
    const Pair& pair = pairs_[node->child];
    const float first = pair.first_share(from);
    if (u < double(first)) {
      keep(u, first);
      node = &pair.nodes[0];
    } else {
      keep(u - double(first), 1 - first);
      node = &pair.nodes[1];
    }
  }
  uint32_t position = node->first();
  if (node->count() > 1) {
    const float inverse = 1 / leaf_power(*node);
    const uint32_t last = position + node->count() - 1;
    float p = powers_[position] * inverse;
    while (position < last && u >= double(p)) {
      u -= double(p);
      p = powers_[++position] * inverse;
    }
    keep(u, p);
  }
  return {order_[position], probability, std::min(float(u), kBelowOne)};
}

float LightTree::probability(uint32_t light, const Point3f& from) const {
  const Place& place = places_[light];
  if (place.position == kNone) return 0;
  const Node* node = &root_;
  float probability = 1;
  for (uint32_t trail = place.trail; !node->is_leaf(); trail >>= 1) {
    const Pair& pair = pairs_[node->child];
    const float first = pair.first_share(from);
    probability *= trail & 1 ? 1 - first : first;
    node = &pair.nodes[trail & 1];
  }
  return node->count() == 1 ? probability
                            : probability * (powers_[place.position] * (1 / leaf_power(*node)));
}

size_t LightTree::memory_bytes() const {
  return pairs_.capacity() * sizeof(Pair) + order_.capacity() * sizeof(uint32_t) +
         powers_.capacity() * sizeof(float) + places_.capacity() * sizeof(Place);
}

bool needs_tree(size_t count, LightSelection selection) {
  if (count > LightTree::kMost) return false;
  if (selection == LightSelection::bvh) return count > 1;
  return selection == LightSelection::automatic && count > kFewLights;
}

}  // namespace duet
