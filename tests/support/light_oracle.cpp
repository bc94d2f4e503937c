#include "support/light_oracle.h"

#include <array>
#include <cmath>
#include <numbers>

namespace duet::test {

namespace {

double angle_of(int8_t cosine) {
  return std::acos(std::max(-1.0, cosine / 127.0));
}

}  // namespace

double importance(const LightTree::Node& node, const Point3f& from) {
  const std::array<double, 3> way{double(from.x) - double(node.center.x),
                                  double(from.y) - double(node.center.y),
                                  double(from.z) - double(node.center.z)};
  double d2 = 0, along = 0;
  for (size_t i = 0; i < 3; ++i) d2 += way[i] * way[i], along += way[i] * node.axis[i] / 32767;
  const double r = double(node.radius), d = std::sqrt(d2);
  if (d <= r) return double(node.intensity) / std::max(r * r, 1.17549435e-38);
  const double theta = std::acos(std::clamp(along / d, -1.0, 1.0));
  const double theta_o = angle_of(node.normals), theta_u = std::asin(std::min(1.0, r / d));
  const double nearest = std::max(0.0, theta - theta_o - theta_u);
  if (nearest > angle_of(node.spread) || nearest > std::numbers::pi / 2) return 0;
  return double(node.intensity) * std::cos(nearest) / d2;
}

std::vector<double> tree_probabilities(const LightTree& tree, size_t lights, const Point3f& from) {
  std::vector<double> result(lights);
  const auto leaf = [&](const LightTree::Node& node, double p) {
    double sum = 0;
    for (uint32_t i = 0; i < node.count(); ++i) sum += double(tree.powers()[node.first() + i]);
    for (uint32_t i = 0; i < node.count(); ++i)
      result[tree.light_order()[node.first() + i]] =
          p * double(tree.powers()[node.first() + i]) / sum;
  };
  const auto pair = [&](const auto& self, uint32_t index, double p) -> void {
    const auto& [a, b] = tree.pairs()[index].nodes;
    double first = importance(a, from), second = importance(b, from);
    if (first + second == 0) first = double(a.intensity), second = double(b.intensity);
    for (const LightTree::Node* node : {&a, &b}) {
      const double share = p * (node == &a ? first : second) / (first + second);
      if (node->is_leaf())
        leaf(*node, share);
      else
        self(self, node->child, share);
    }
  };
  if (tree.pairs().empty()) {
    double sum = 0;
    for (const float p : tree.powers()) sum += double(p);
    for (size_t i = 0; i < tree.light_order().size(); ++i)
      result[tree.light_order()[i]] = double(tree.powers()[i]) / sum;
  } else {
    pair(pair, 0, 1);
  }
  return result;
}

double direct_probability(const Scene& scene, uint32_t light, const Point3f& from) {
  // The choice for emission is that by power.
  const double w = double(scene.emission_picker.probability(light));
  const LightTree* tree = scene.direct_picker.tree();
  if (!tree) return w;
  double share = 0;
  for (const uint32_t i : tree->light_order())
    share += double(scene.emission_picker.probability(i));
  const auto by_tree = tree_probabilities(*tree, scene.lights.size(), from);
  if (is_infinite(scene.lights[light]->kind())) return w;
  return 0.1 * w + 0.9 * share * by_tree[light];
}

}  // namespace duet::test
