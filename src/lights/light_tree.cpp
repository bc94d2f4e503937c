#include "lights/light_tree.h"

#include "math/warp.h"

namespace duet {

namespace {

/// Times a number it is below that number, whatever rounding does.
constexpr double kLargestVariate = 1 - 0x1p-52;

}  // namespace

LightTree::Pick LightTree::sample(double u, const Point3f& from) const {
  u = std::min(u, kLargestVariate);
  float probability = 1;
  uint32_t child = 0;
  LightEstimates estimates;
  float all = 1;  // the power of what is left to choose from
  for (bool by_power = false; !by_power;) {
    const LightNodes& group = groups_[child];
    estimate(group, directed_, from, estimates);
    // Without branches, which would be hard to predict.
    const double target = u * double(estimates.sums[LightNodes::kCount - 1]);
    int chosen = 0;
    for (int i = 0; i < LightNodes::kCount - 1; ++i) chosen += target >= double(estimates.sums[i]);
    const double before = chosen > 0 ? double(estimates.sums[chosen - 1]) : 0;
    u = std::min((target - before) / double(estimates.importance[chosen]), kLargestVariate);
    probability *= estimates.share(chosen);
    child = group.child[chosen];
    all = group.power[chosen];
    by_power = Leaf::is(child) || estimates.even[chosen];
  }
  double rest = u * double(all);
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
  return {order_[position], probability * (own / all),
          std::min(float(rest / double(own)), kBelowOne)};
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
