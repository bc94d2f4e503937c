#include "support/light_oracle.h"

#include <array>
#include <cmath>
#include <numbers>

namespace duet::test {

Estimate estimate(const LightNode& node, bool directed, const Point3f& from) {
  const std::array<double, 3> way{double(from.x) - double(node.center.x),
                                  double(from.y) - double(node.center.y),
                                  double(from.z) - double(node.center.z)};
  double d2 = 0, along = 0;
  for (size_t i = 0; i < 3; ++i) {
    d2 += way[i] * way[i];
    along += way[i] * double(node.axis[int(i)]);
  }
  const double r = double(node.radius), d = std::sqrt(d2), intensity = double(node.intensity);
  if (d <= r) return {intensity / std::max(r * r, 1e-30), -1};
  if (!directed)
    return {intensity / d2, double(LightEstimates::kEven) * std::pow((d - r) / (d + r), 2) - 1};
  const double theta = std::acos(std::clamp(along / d, -1.0, 1.0));
  const double theta_o = std::acos(std::max(-1.0, double(node.normals)));
  const double theta_e = std::acos(std::max(0.0, double(node.spread)));
  const double theta_u = std::asin(r / d), bound = theta_o + theta_u;
  const double nearest = std::max(0.0, theta - bound), furthest = theta + bound;
  const double importance = nearest <= theta_e ? intensity * std::cos(nearest) / d2 : 0;
  if (node.normals <= -1 || bound >= std::numbers::pi || furthest >= theta_e)
    return {importance, -1};
  const double far = std::cos(furthest) / std::pow(d + r, 2),
               near = std::cos(nearest) / std::pow(d - r, 2);
  return {importance, double(LightEstimates::kEven) * far / near - 1};
}

std::vector<double> tree_probabilities(const LightTree& tree, size_t lights, const Point3f& from) {
  std::vector<double> result(lights);
  const auto by_power = [&](const auto& self, uint32_t child, double p, double power) -> void {
    if (LightTree::Leaf::is(child)) {
      const auto [first, count] = LightTree::Leaf::of(child);
      for (uint32_t i = first; i < first + count; ++i)
        result[tree.light_order()[i]] = p * double(tree.powers()[i]) / power;
      return;
    }
    const LightNodes& group = tree.groups()[child];
    for (int i = 0; i < LightNodes::kCount; ++i)
      if (group.power[i] > 0) self(self, group.child[i], p, power);
  };
  const auto choose = [&](const auto& self, uint32_t number, double p) -> void {
    const LightNodes& group = tree.groups()[number];
    LightEstimates single;
    estimate(group, tree.directed(), from, single);
    std::array<Estimate, LightNodes::kCount> estimates{};
    double sum = 0, intensities = 0;
    for (int i = 0; i < LightNodes::kCount; ++i) {
      if (!(group.power[i] > 0)) continue;
      estimates[size_t(i)] = estimate(group.get(i), tree.directed(), from);
      sum += estimates[size_t(i)].importance;
      intensities += double(group.intensity[i]);
    }
    for (int i = 0; i < LightNodes::kCount; ++i) {
      if (!(group.power[i] > 0)) continue;
      const auto [importance, spare] = estimates[size_t(i)];
      const double share = sum > 0 ? importance / sum : double(group.intensity[i]) / intensities;
      // At the bound itself rounding decides.
      const bool even = std::abs(spare) < 1e-3 ? single.even[i] != 0 : spare > 0;
      if (even || LightTree::Leaf::is(group.child[i]))
        by_power(by_power, group.child[i], p * share, double(group.power[i]));
      else
        self(self, group.child[i], p * share);
    }
  };
  if (!tree.empty()) choose(choose, 0, 1);
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
