#include "lights/light_tree.h"

#include <array>
#include <utility>

#include "math/warp.h"

namespace duet {

LightTree::Step LightTree::step(const LightNodes& group, const NodeChoice& choice, bool even) {
  const uint32_t child = group.child[choice.node];
  const float power = group.power[choice.node];
  const bool by_power = Leaf::is(child) || even;
  return {by_power ? choice.u * double(power) : choice.u, choice.probability, child, power,
          by_power};
}

LightTree::Step LightTree::first_step(double u, const Point3f& from) const {
  LightEstimates estimates;
  estimate(groups_.front(), directed_, from, estimates);
  const NodeChoice choice = estimates.choose(u);
  return step(groups_.front(), choice, estimates.even[choice.node]);
}

uint32_t LightTree::choose_by_power(const LightNodes& group, double& u) {
  int chosen = 0;
  for (int i = 1; i < LightNodes::kCount && u >= double(group.power[chosen]); ++i)
    if (group.power[i] > 0) u -= double(group.power[chosen]), chosen = i;
  return group.child[chosen];
}

LightTree::Step LightTree::next(const Step& s, const Point3f& from) const {
  const LightNodes& group = groups_[s.child];
  Step result = s;
  if (s.by_power) {
    result.child = choose_by_power(group, result.u);
    return result;
  }
  LightEstimates estimates;
  estimate(group, directed_, from, estimates);
  const NodeChoice choice = estimates.choose(s.u);
  result = step(group, choice, estimates.even[choice.node]);
  result.probability = s.probability * choice.probability;
  return result;
}

LightTree::Pick LightTree::finish(const Step& s) const {
  const Leaf leaf = Leaf::of(s.child);
  double rest = s.u;
  uint32_t position = leaf.first;
  const uint32_t last = position + leaf.count - 1;
  while (position < last && rest >= double(powers_[position])) rest -= double(powers_[position++]);
  const float own = powers_[position];
  return {order_[position], s.probability * (own / s.power),
          std::min(float(rest / double(own)), kBelowOne), own};
}

LightTree::Pick LightTree::sample(double u, const Point3f& from) const {
  Step s = first_step(u, from);
  while (!s.ends()) s = next(s, from);
  return finish(s);
}

[[gnu::always_inline]] inline void LightTree::prefetch(const Step& s) const {
  if (s.ends()) {
    const uint32_t first = Leaf::of(s.child).first;
    __builtin_prefetch(&powers_[first]);
    __builtin_prefetch(&order_[first]);
    return;
  }
  const LightNodes& group = groups_[s.child];
  __builtin_prefetch(group.power);
  __builtin_prefetch(group.child);
  if (s.by_power) return;
  for (const float* const line : {group.x, group.z, group.axis_y, group.normals})
    __builtin_prefetch(line);
}

void LightTree::descend(std::span<Way> ways, Pick* picks) {
  std::array<uint32_t, NodeChoices::kPoints> active;
  uint32_t count = 0;
  const auto go_to = [&](uint32_t k) {
    ways[k].tree->prefetch(ways[k].step);
    active[count] = k;
    count += !ways[k].step.ends();
  };
  for (uint32_t k = 0; k < ways.size(); ++k) go_to(k);
  while (count > 0) {
    const uint32_t before = std::exchange(count, 0);
    for (uint32_t a = 0; a < before; ++a) {
      Way& way = ways[active[a]];
      way.step = way.tree->next(way.step, way.from);
      go_to(active[a]);
    }
  }
  for (size_t k = 0; k < ways.size(); ++k) picks[k] = ways[k].tree->finish(ways[k].step);
}

void LightTree::sample(const BatchTriples& from, int first, int n, NodeChoices& choices,
                       Pick* picks) const {
  const LightNodes& root = groups_.front();
  choose_nodes(root, directed_, from, first, n, choices);
  std::array<Way, NodeChoices::kPoints> ways;
  for (int i = 0; i < n; ++i)
    ways[size_t(i)] = {
        this, from.point(first + i),
        step(root, {choices.node[i], choices.u[i], choices.probability[i]}, choices.even[i] != 0)};
  descend({ways.data(), size_t(n)}, picks);
}

void LightTree::sample(std::span<const Query> queries, Pick* picks) {
  std::array<Way, NodeChoices::kPoints> ways;
  while (!queries.empty()) {
    const size_t n = std::min(queries.size(), ways.size());
    for (size_t k = 0; k < n; ++k) {
      const Query& q = queries[k];
      ways[k] = {q.tree, q.from, q.tree->first_step(q.u, q.from)};
    }
    descend({ways.data(), n}, picks);
    queries = queries.subspan(n);
    picks += n;
  }
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
