#include "lights/light_tree.h"

#include "math/warp.h"

namespace duet {

LightTree::Step LightTree::step(const LightNodes& group, const NodeChoice& choice, bool even) {
  const uint32_t child = group.child[choice.node];
  return {choice.u, choice.probability, child, group.power[choice.node], Leaf::is(child) || even};
}

LightTree::Pick LightTree::sample(double u, const Point3f& from) const {
  LightEstimates estimates;
  estimate(groups_.front(), directed_, from, estimates);
  const NodeChoice choice = estimates.choose(u);
  return descend(step(groups_.front(), choice, estimates.even[choice.node]), from);
}

LightTree::Pick LightTree::descend(Step s, const Point3f& from) const {
  LightEstimates estimates;
  while (!s.by_power) {
    const LightNodes& group = groups_[s.child];
    estimate(group, directed_, from, estimates);
    const NodeChoice choice = estimates.choose(s.u);
    const float probability = s.probability * choice.probability;
    s = step(group, choice, estimates.even[choice.node]);
    s.probability = probability;
  }
  double rest = s.u * double(s.power);
  uint32_t child = s.child;
  while (!Leaf::is(child)) {
    const LightNodes& group = groups_[child];
    int chosen = 0;
    for (int i = 1; i < LightNodes::kCount && rest >= double(group.power[chosen]); ++i)
      if (group.power[i] > 0) rest -= double(group.power[chosen]), chosen = i;
    child = group.child[chosen];
  }
  const Leaf leaf = Leaf::of(child);
  uint32_t position = leaf.first;
  const uint32_t last = position + leaf.count - 1;
  while (position < last && rest >= double(powers_[position])) rest -= double(powers_[position++]);
  const float own = powers_[position];
  return {order_[position], s.probability * (own / s.power),
          std::min(float(rest / double(own)), kBelowOne)};
}

void LightTree::sample(const BatchTriples& from, int first, int n, NodeChoices& choices,
                       Pick* picks) const {
  const LightNodes& root = groups_.front();
  choose_nodes(root, directed_, from, first, n, choices);
  for (int i = 0; i < n; ++i)
    picks[i] = descend(
        step(root, {choices.node[i], choices.u[i], choices.probability[i]}, choices.even[i] != 0),
        from.point(first + i));
}

float LightTree::probability(uint32_t light, const Point3f& from) const {
  const Place& place = places_[light];
  if (place.position == kNone) return 0;
  float probability = 1;
  uint32_t child = 0, trail = place.trail;
  LightEstimates estimates;
  while (true) {
    const LightNodes& group = groups_[child];
    const uint32_t i = trail % LightNodes::kCount;
    estimate(group, directed_, from, estimates);
    probability *= estimates.share(int(i));
    child = group.child[i];
    if (Leaf::is(child) || estimates.even[i])
      return probability * (powers_[place.position] / group.power[i]);
    trail /= LightNodes::kCount;
  }
}

size_t LightTree::memory_bytes() const {
  return groups_.capacity() * sizeof(LightNodes) + order_.capacity() * sizeof(uint32_t) +
         powers_.capacity() * sizeof(float) + places_.capacity() * sizeof(Place);
}

bool needs_tree(size_t count, LightSelection selection) {
  if (count > LightTree::kMost) return false;
  if (selection == LightSelection::bvh) return count > 1;
  return selection == LightSelection::automatic && count > kFewLights;
}

}  // namespace duet
