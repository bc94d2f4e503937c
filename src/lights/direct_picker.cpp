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

LightPicker::Pick DirectPicker::pick_by_tree(float u, const Point2f& others,
                                             const Point3f& from) const {
  const double fine = fine_variate(u, others), share = double(tree_share_);
  if (fine < share) {
    const LightTree::Pick pick = tree_->sample(fine / share, from);
    return {pick.light,
            base_.probability(pick.light) * (1 - tree_share_) + tree_share_ * pick.probability};
  }
  const float rest = std::min(float((fine - share) / (1 - share)), kBelowOne);
  const uint32_t light = base_.pick(rest, others).light;
  return {light, probability(light, from)};
}

}  // namespace duet
