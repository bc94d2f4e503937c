#include "lights/light_tree.h"

#include <doctest/doctest.h>

#include <bit>

#include "math/hash.h"
#include "math/warp.h"
#include "support/light_oracle.h"

using namespace duet;
using namespace duet::test;

namespace {

/// Numbers in [0, 1), one after the other.
class Random {
 public:
  float operator()() { return to_unit_float(uint32_t(mix64(++state_) >> 32)); }
  Point3f point(float size) {
    return {size * ((*this)() - 0.5f), size * ((*this)() - 0.5f), size * ((*this)() - 0.5f)};
  }
  Vector3f direction() { return square_to_sphere({(*this)(), (*this)()}); }

 private:
  uint64_t state_ = 0x51ed;
};

LightBounds at(const Point3f& p, float power) {
  LightBounds b = LightBounds::around({p, p});
  b.power = power;
  return b;
}

/// A small flat light.
LightBounds panel(const Point3f& p, const Vector3f& normal, float size, float power) {
  LightBounds b;
  const float half = 0.5f * size;
  b.box = {p - Vector3f(half, half, half), p + Vector3f(half, half, half)};
  b.normals = {normal};
  b.power = power;
  return b;
}

/// Points, panels and spots with powers over four decades, some of them dark.
std::vector<LightBounds> mixed_lights(uint32_t count) {
  Random random;
  std::vector<LightBounds> lights;
  for (uint32_t i = 0; i < count; ++i) {
    const Point3f p = random.point(10);
    const float power = i % 11 == 10 ? 0.0f : std::pow(10.0f, 4 * random() - 2);
    lights.push_back(i % 3 == 0 ? at(p, power) : panel(p, random.direction(), 0.3f, power));
    if (i % 3 == 2) {
      lights.back().box = {p, p};
      lights.back().normals.angle = 0.4f;
      lights.back().spread = 0;
    }
  }
  return lights;
}

/// Over those that have power.
LightTree make_tree(const std::vector<LightBounds>& lights, uint32_t leaf_size) {
  std::vector<LightTree::Entry> entries;
  for (uint32_t i = 0; i < lights.size(); ++i)
    if (lights[i].power > 0) entries.push_back({lights[i], i});
  return LightTree(std::move(entries), uint32_t(lights.size()), leaf_size);
}

}  // namespace

TEST_CASE("a cone that is extended holds both") {
  Random random;
  const auto holds = [](const DirectionCone& a, const DirectionCone& b, const Vector3f& edge) {
    // A direction on the edge of b.
    const Frame frame{Normal3f(b.axis)};
    const Vector3f w =
        frame.to_world({std::sin(b.angle) * edge.x, std::sin(b.angle) * edge.y, std::cos(b.angle)});
    return std::acos(std::clamp(dot(w, a.axis), -1.0f, 1.0f)) <= a.angle + 2e-3f;
  };
  for (int i = 0; i < 5000; ++i) {
    const float wide = i % 2 ? kPi : 0.3f;
    const DirectionCone a{random.direction(), wide * random()}, b{i % 7   ? random.direction()
                                                                  : i % 2 ? a.axis
                                                                          : -a.axis,
                                                                  wide * random()};
    DirectionCone both = a;
    both.extend(b);
    CHECK(both.angle <= std::min(kPi, a.angle + b.angle + kPi) + 1e-3f);
    for (int k = 0; k < 8; ++k) {
      const Vector3f edge(std::cos(float(k)), std::sin(float(k)), 0);
      CHECK(holds(both, a, edge));
      CHECK(holds(both, b, edge));
    }
  }
  // As narrow as it can be.
  DirectionCone right{{1, 0, 0}, 0.1f};
  right.extend({{0, 1, 0}, 0.2f});
  CHECK(right.angle == doctest::Approx(0.25 * double(kPi) + 0.15));
}

TEST_CASE("the measure of a bound on directions") {
  const auto measure = [](float angle, float spread) {
    LightBounds b;
    b.normals.angle = angle, b.spread = spread;
    double sum = 0;
    constexpr int n = 20000;
    for (int i = 0; i < n; ++i) {
      const double theta = double(kPi) * (i + 0.5) / n,
                   beyond = std::max(0.0, theta - double(angle));
      if (beyond <= double(spread)) sum += std::cos(beyond) * std::sin(theta);
    }
    CHECK(double(b.measure()) ==
          doctest::Approx(2 * double(kPi) * double(kPi) * sum / n).epsilon(1e-3));
    return b.measure();
  };
  CHECK(measure(0, 0.5f * kPi) == doctest::Approx(double(kPi)));
  CHECK(measure(kPi, 0.5f * kPi) == doctest::Approx(4 * double(kPi)));
  for (const float angle : {0.2f, 0.9f, 1.6f, 2.5f})
    for (const float spread : {0.0f, 0.3f, 0.5f * kPi}) measure(angle, spread);
}

TEST_CASE("a light tree's probabilities are those of its definition and sum to one") {
  Random random;
  for (const uint32_t leaf_size : {1u, 4u}) {
    const auto lights = mixed_lights(37);
    const LightTree tree = make_tree(lights, leaf_size);
    double worst_sum = 0, worst = 0;
    for (int i = 0; i < 20000; ++i) {
      const Point3f from = random.point(i % 2 ? 12.0f : 60.0f);
      const auto expected = tree_probabilities(tree, lights.size(), from);
      double sum = 0;
      for (uint32_t l = 0; l < lights.size(); ++l) {
        const double p = double(tree.probability(l, from));
        sum += p;
        worst = std::max(worst, std::abs(p - expected[l]));
        if (!(lights[l].power > 0)) CHECK(p == 0);
      }
      worst_sum = std::max(worst_sum, std::abs(sum - 1));
    }
    CHECK(worst_sum < 1e-5);
    CHECK(worst < 2e-3);  // where a cosine is near that of an edge
  }
}

TEST_CASE("light choices sum to one at 100,000 points") {
  Random random;
  const auto lights = mixed_lights(12);
  const LightTree tree = make_tree(lights, 1);
  double worst = 0;
  for (int i = 0; i < 100000; ++i) {
    const Point3f from = random.point(20);
    double sum = 0;
    for (uint32_t l = 0; l < lights.size(); ++l) sum += double(tree.probability(l, from));
    worst = std::max(worst, std::abs(sum - 1));
  }
  CHECK(worst < 1e-5);
}

TEST_CASE("a light tree chooses as often as it says") {
  Random random;
  constexpr int n = 200000;
  for (const uint32_t leaf_size : {1u, 3u}) {
    const auto lights = mixed_lights(29);
    const LightTree tree = make_tree(lights, leaf_size);
    for (int k = 0; k < 4; ++k) {
      const Point3f from = random.point(12);
      std::vector<int> count(lights.size());
      std::vector<double> rest(lights.size());
      for (int i = 0; i < n; ++i) {
        const LightTree::Pick pick = tree.sample((i + 0.5) / n, from);
        ++count[pick.light];
        rest[pick.light] += double(pick.remapped);
        REQUIRE(pick.probability == doctest::Approx(double(tree.probability(pick.light, from))));
        REQUIRE(pick.remapped >= 0);
        REQUIRE(pick.remapped < 1);
      }
      for (uint32_t l = 0; l < lights.size(); ++l) {
        // Each light has one interval of u.
        CHECK(std::abs(count[l] - n * double(tree.probability(l, from))) < 1.5);
        if (count[l] > 1000) CHECK(rest[l] / count[l] == doctest::Approx(0.5).epsilon(0.005));
      }
    }
  }
}

TEST_CASE("no light that reaches a point is out of reach there") {
  Random random;
  const auto lights = mixed_lights(200);
  const LightTree tree = make_tree(lights, 1);
  int lit = 0;
  for (int i = 0; i < 5000; ++i) {
    const Point3f from = random.point(15);
    for (uint32_t l = 0; l < lights.size(); ++l) {
      const LightBounds& b = lights[l];
      if (!(b.power > 0)) continue;
      const Vector3f way = normalize(from - b.box.center());
      const float angle = std::acos(std::clamp(dot(way, b.normals.axis), -1.0f, 1.0f));
      if (angle > b.normals.angle + b.spread - 0.02f) continue;
      ++lit;
      REQUIRE(tree.probability(l, from) > 0);
    }
  }
  CHECK(lit > 100000);
}

TEST_CASE("near lights are preferred to far ones, and those that face a point to others") {
  std::vector<LightBounds> lights;
  for (int i = 0; i < 100; ++i) lights.push_back(at(Point3f(float(i), 0, 0), 1));
  const LightTree row = make_tree(lights, 1);
  // By the inverse squared distance, 1 + Σ 1/k² of both sides shares with the one below.
  CHECK(row.probability(50, {50, 0, 1}) > 0.15f);
  CHECK(row.probability(50, {50, 0, 1}) > 30 * row.probability(60, {50, 0, 1}));
  const std::vector<LightBounds> two{panel({0, 0, 0}, {0, 0, 1}, 0.1f, 1),
                                     panel({0.2f, 0, 0}, {0, 0, -1}, 0.1f, 1)};
  const LightTree pair = make_tree(two, 1);
  CHECK(pair.probability(0, {0, 0, 3}) == 1);
  CHECK(pair.probability(1, {0, 0, -3}) == 1);
}

TEST_CASE("far lights that differ little are chosen by power") {
  std::vector<LightBounds> lights;
  for (int i = 0; i < 100; ++i)
    lights.push_back(panel({float(i), 0, 0}, {0, 0, 1}, 0.1f, i == 1 ? 3.0f : 1.0f));
  const LightTree tree = make_tree(lights, 1);
  const auto ratio = [&](const Point3f& from) {
    return tree.probability(1, from) / tree.probability(0, from);
  };
  CHECK(ratio({50, 0, 500}) == doctest::Approx(3).epsilon(1e-5));
  CHECK(ratio({0, 0, 0.5f}) < 1);
  CHECK(ratio({1, 0, 0.5f}) > 9);
}

TEST_CASE("lights of a wide cone are not alike from behind") {
  LightNodes nodes{};
  LightNode node;
  node.center = Point3f(0, 0, 0), node.axis = Vector3f(0, 0, 1);
  node.radius = 1, node.power = node.intensity = 1;
  node.normals = std::cos(150 * kPi / 180);
  nodes.set(0, node);
  LightEstimates estimates;
  estimate(nodes, true, {0, 0, -50}, estimates);
  CHECK(estimates.importance[0] > 0);
  CHECK(estimates.even[0] == 0);
}

TEST_CASE("lights of next to no power have probabilities") {
  std::vector<LightBounds> lights{at({1000, 0, 0}, 1)};
  for (int i = 0; i < 20; ++i) lights.push_back(at({float(i), 0, 0}, 1e-37f));
  const LightTree tree = make_tree(lights, 1);
  double sum = 0;
  for (uint32_t l = 0; l < lights.size(); ++l) sum += double(tree.probability(l, {0, 1, 0}));
  CHECK(sum == doctest::Approx(1).epsilon(1e-5));
}

TEST_CASE("lights in awkward places are all found") {
  const auto check = [](const std::vector<LightBounds>& lights, uint32_t leaf_size) {
    const LightTree tree = make_tree(lights, leaf_size);
    CHECK(tree.light_order().size() == lights.size());
    for (const Point3f& from : {Point3f(0, 0, 0), Point3f(3, 1e-20f, 2), Point3f(1e30f, 0, 0)}) {
      double sum = 0;
      for (uint32_t l = 0; l < lights.size(); ++l) {
        const float p = tree.probability(l, from);
        REQUIRE(p >= 0);
        sum += double(p);
      }
      CHECK(sum == doctest::Approx(1).epsilon(1e-5));
      for (int i = 0; i < 100; ++i) CHECK(tree.sample(i / 100.0, from).light < lights.size());
    }
  };
  std::vector<LightBounds> same(1000, at({1, 2, 3}, 2)), line, halving;
  for (int i = 0; i < 300; ++i) line.push_back(at({0, 0, float(i * i)}, 1));
  // A split at a time would need more bits than a trail has.
  for (int i = 0; i < 120; ++i) halving.push_back(at({std::ldexp(1.0f, -i), 0, 0}, 1));
  for (const uint32_t leaf_size : {1u, 8u}) {
    check(same, leaf_size);
    check(line, leaf_size);
    check(halving, leaf_size);
    check({at({0, 0, 0}, 1e-30f)}, leaf_size);
  }
  const std::vector<LightBounds> dark(3, at({0, 0, 0}, 0));
  CHECK(make_tree(dark, 1).empty());
  CHECK(make_tree(dark, 1).probability(1, {1, 1, 1}) == 0);
}

TEST_CASE("a light tree's nodes hold what is below them") {
  const auto lights = mixed_lights(300);
  const LightTree tree = make_tree(lights, 2);
  const auto below = [&](const auto& self, uint32_t child, std::vector<uint32_t>& found) -> void {
    if (LightTree::Leaf::is(child)) {
      const auto [first, count] = LightTree::Leaf::of(child);
      for (uint32_t i = first; i < first + count; ++i) found.push_back(tree.light_order()[i]);
      return;
    }
    const LightNodes& group = tree.groups()[child];
    for (int i = 0; i < LightNodes::kCount; ++i)
      if (group.power[i] > 0) self(self, group.child[i], found);
  };
  size_t at_the_top = 0;
  for (size_t number = 0; number < tree.groups().size(); ++number)
    for (int i = 0; i < LightNodes::kCount; ++i) {
      const LightNode node = tree.groups()[number].get(i);
      if (!(node.power > 0)) continue;
      std::vector<uint32_t> held;
      below(below, node.child, held);
      if (number == 0) at_the_top += held.size();
      float power = 0;
      for (const uint32_t l : held) power += lights[l].power / tree.bounds().power;
      CHECK(node.power == doctest::Approx(double(power)).epsilon(1e-4));
      if (node.normals <= -1)
        CHECK(node.intensity == doctest::Approx(double(power / (4 * kPi))).epsilon(0.01));
      for (const uint32_t l : held) {
        const LightBounds& b = lights[l];
        CHECK(distance(b.box.center(), node.center) <= node.radius * 1.0001f + 1e-5f);
        if (node.normals <= -1) continue;
        const float between =
            std::acos(std::clamp(dot(b.normals.axis, normalize(node.axis)), -1.0f, 1.0f));
        REQUIRE(b.normals.angle < kPi);
        CHECK(between + b.normals.angle <= std::acos(node.normals) + 2e-3f);
      }
    }
  CHECK(at_the_top == tree.light_order().size());
  CHECK(tree.memory_bytes() < lights.size() * 90);
}
