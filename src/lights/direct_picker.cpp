#include "lights/direct_picker.h"

#include <algorithm>
#include <numeric>

namespace duet {

namespace {

/// The lights that a tree can help to choose, with powers times factors.
std::vector<LightTree::Entry> tree_entries(std::span<const std::unique_ptr<Light>> lights,
                                           std::span<const double> factors, double scene_radius) {
  std::vector<LightTree::Entry> entries;
  for (size_t i = 0; i < lights.size(); ++i) {
    std::optional<LightBounds> bounds = lights[i]->bounds();
    if (!bounds) continue;
    bounds->power = float(lights[i]->power(scene_radius) * factors[i]);
    if (bounds->power > 0) entries.push_back({*bounds, uint32_t(i)});
  }
  return entries;
}

}  // namespace

DirectPicker::DirectPicker(std::span<const std::unique_ptr<Light>> lights,
                           std::span<const double> factors, double scene_radius,
                           LightSelection selection) {
  std::vector<float> weights = selection_weights(lights, factors, scene_radius);
  if (selection == LightSelection::uniform)
    for (size_t i = 0; i < weights.size(); ++i) weights[i] = weights[i] > 0 ? float(factors[i]) : 0;
  if (needs_tree(lights.size(), selection)) {
    auto entries = tree_entries(lights, factors, scene_radius);
    if (needs_tree(entries.size(), selection)) {
      const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
      for (const LightTree::Entry& e : entries) weights[e.light] *= kEvenShare;
      tree_share_ = float(1 - std::accumulate(weights.begin(), weights.end(), 0.0) / all);
      tree_ = std::make_unique<LightTree>(std::move(entries), uint32_t(lights.size()), 1);
    }
  }
  base_ = LightPicker(weights);
}

LightPicker::Pick DirectPicker::of_tree(const LightTree::Pick& pick) const {
  return {pick.light,
          base_.probability(pick.light) * (1 - tree_share_) + tree_share_ * pick.probability};
}

LightPicker::Pick DirectPicker::pick_evenly(double fine, const Point2f& others,
                                            const Point3f& from) const {
  const double share = double(tree_share_);
  const float rest = std::min(float((fine - share) / (1 - share)), kBelowOne);
  const uint32_t light = base_.pick(rest, others).light;
  return {light, probability(light, from)};
}

LightPicker::Pick DirectPicker::pick_by_tree(float u, const Point2f& others,
                                             const Point3f& from) const {
  const double fine = fine_variate(u, others), share = double(tree_share_);
  return fine < share ? of_tree(tree_->sample(fine / share, from))
                      : pick_evenly(fine, others, from);
}

void DirectPicker::pick(int n, const LightVariates& numbers, const BatchTriples& from,
                        LightChoices& choices) const {
  if (tree_) return pick_by_tree(n, numbers, from, choices);
  for (int i = 0; i < n; ++i) {
    const LightPicker::Pick pick = base_.pick(numbers.u[i], {numbers.x[i], numbers.y[i]});
    choices.light[i] = pick.light;
    choices.probability[i] = pick.probability;
  }
}

void DirectPicker::pick_by_tree(int n, const LightVariates& numbers, const BatchTriples& from,
                                LightChoices& choices) const {
  const double share = double(tree_share_);
  NodeChoices nodes;
  double fine[NodeChoices::kPoints];
  LightTree::Pick picks[NodeChoices::kPoints];
  for (int first = 0; first < n; first += NodeChoices::kPoints) {
    const int count = std::min(n - first, NodeChoices::kPoints);
    for (int k = 0; k < count; ++k) {
      const int i = first + k;
      fine[k] = fine_variate(numbers.u[i], {numbers.x[i], numbers.y[i]});
      // Those beyond the share are chosen otherwise below.
      nodes.u[k] = fine[k] < share ? fine[k] / share : 0;
    }
    tree_->sample(from, first, count, nodes, picks);
    for (int k = 0; k < count; ++k) {
      const int i = first + k;
      const LightPicker::Pick pick =
          fine[k] < share ? of_tree(picks[k])
                          : pick_evenly(fine[k], {numbers.x[i], numbers.y[i]}, from.point(i));
      choices.light[i] = pick.light;
      choices.probability[i] = pick.probability;
    }
  }
}

}  // namespace duet
