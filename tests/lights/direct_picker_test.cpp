#include "lights/direct_picker.h"

#include <doctest/doctest.h>

#include "lights/beam.h"
#include "lights/delta.h"
#include "lights/environment.h"
#include "media/random_stream.h"

using namespace duet;

namespace {

struct Lights {
  std::vector<std::unique_ptr<Light>> lights;
  std::vector<double> factors;
  void point(const Point3f& p, float intensity = 1, double factor = 1) {
    lights.push_back(std::make_unique<PointEmitter>(p, Spectrum(intensity)));
    factors.push_back(factor);
  }
  void spot(const Point3f& p) {
    lights.push_back(std::make_unique<SpotEmitter>(
        Transform(Matrix4::translate(double(p.x), double(p.y), double(p.z))), Spectrum(1), 0.5, 0.4,
        nullptr));
    factors.push_back(1);
  }
  void sky() {
    lights.push_back(std::make_unique<ConstantEnvironment>(Spectrum(1)));
    factors.push_back(1);
  }
  void beam() {
    lights.push_back(std::make_unique<CollimatedBeam>(Transform(), Spectrum(1)));
    factors.push_back(1);
  }
  DirectPicker picker(LightSelection selection) const {
    return DirectPicker(lights, factors, 1, selection);
  }
  LightPicker by_power() const { return LightPicker(selection_weights(lights, factors, 1)); }
};

/// A row of points, a sky and a beam.
Lights row(int count) {
  Lights l;
  for (int i = 0; i < count; ++i) l.point({float(i), 0, 0}, 1 + float(i % 3), i == 1 ? 4 : 1);
  l.sky();
  l.beam();
  return l;
}

}  // namespace

TEST_CASE("few lights are chosen by power, and many by a tree") {
  using enum LightSelection;
  CHECK(!row(4).picker(automatic).tree());
  CHECK(row(5).picker(automatic).tree());
  CHECK(row(2).picker(bvh).tree());
  CHECK(!row(1).picker(bvh).tree());
  CHECK(!row(9).picker(power).tree());
  CHECK(!row(9).picker(uniform).tree());
  // Lights that are dark or everywhere do not count.
  Lights l = row(4);
  l.point({0, 0, 0}, 0), l.point({0, 0, 0}, 1, 0);
  CHECK(!l.picker(automatic).tree());
  CHECK(DirectPicker().size() == 0);
}

TEST_CASE("a tree mixes with the choice by power, which all other lights keep") {
  const Lights l = row(40);
  const DirectPicker picker = l.picker(LightSelection::automatic);
  const LightPicker power = l.by_power();
  REQUIRE(picker.tree());
  const auto count = uint32_t(l.lights.size()), points = count - 2;
  float in_tree = 0;
  for (uint32_t i = 0; i < points; ++i) in_tree += power.probability(i);
  for (const Point3f& from : {Point3f(3, 1, 0), Point3f(100, 2, 5), Point3f(17, 0, 0)}) {
    double sum = 0;
    for (uint32_t i = 0; i < count; ++i) {
      const float p = picker.probability(i, from), w = power.probability(i);
      sum += double(p);
      if (i >= points)
        CHECK(p == doctest::Approx(double(w)).epsilon(1e-4));
      else
        CHECK(p == doctest::Approx(
                       double(0.1f * w + 0.9f * in_tree * picker.tree()->probability(i, from)))
                       .epsilon(1e-4));
    }
    CHECK(sum == doctest::Approx(1).epsilon(1e-5));
  }
}

TEST_CASE("lights are picked as often as is said, with or without a tree") {
  constexpr int n = 100000;
  const Lights l = row(12);
  for (const LightSelection s :
       {LightSelection::automatic, LightSelection::power, LightSelection::uniform}) {
    const DirectPicker picker = l.picker(s);
    const Point3f from(7, 0.5f, 0);
    std::vector<int> counts(l.lights.size());
    for (int i = 0; i < n; ++i) {
      const auto pick = picker.pick((float(i) + 0.5f) / n, {0.3f, 0.7f}, from);
      ++counts[pick.light];
      REQUIRE(pick.probability == doctest::Approx(double(picker.probability(pick.light, from))));
    }
    for (uint32_t i = 0; i < counts.size(); ++i)
      CHECK(std::abs(counts[i] - n * double(picker.probability(i, from))) < 6);
  }
}

TEST_CASE("factors multiply what a light gets, near or far, and uniform shares") {
  Lights a, b;
  for (int i = 0; i < 8; ++i)
    a.point({float(i), 0, 0}), b.point({float(i), 0, 0}, 1, i == 7 ? 0 : i == 0 ? 4 : 1);
  const Point3f from(3.5f, 0, 50);
  const DirectPicker x = a.picker(LightSelection::automatic),
                     y = b.picker(LightSelection::automatic);
  CHECK(y.probability(7, from) == 0);
  const auto ratio = [&](const DirectPicker& p) {
    return double(p.probability(0, from) / p.probability(1, from));
  };
  // The two are one pair of the tree or near it, and everything is about as far.
  CHECK(ratio(y) / ratio(x) == doctest::Approx(4).epsilon(0.1));
  const DirectPicker even = b.picker(LightSelection::uniform);
  CHECK(even.probability(0, from) == doctest::Approx(0.4));
  CHECK(even.probability(1, from) == doctest::Approx(0.1));
  CHECK(even.probability(7, from) == 0);
}

TEST_CASE("the lights of many points are those of one after the other, bit for bit") {
  RandomStream random(3);
  BatchArray<float> u, x, y;
  BatchTriples from;
  LightChoices choices;
  const int n = kBatch - 3;  // no multiple of what is looked at together
  // A tree over spots alone has nothing to go by behind them but intensities.
  for (const bool points : {true, false}) {
    for (const int count : {1, 2, 4, 5, 8, 9, 40}) {
      CAPTURE(points);
      CAPTURE(count);
      Lights l = row(points ? count : 0);
      for (int i = 0; i < count; ++i) l.spot({float(i), 0, 3});
      const DirectPicker picker = l.picker(LightSelection::automatic);
      for (int i = 0; i < n; ++i) {
        u[i] = random.next(), x[i] = random.next(), y[i] = random.next();
        from.set(i, float(count) * random.next(), random.next(), 6 * random.next());
      }
      from.set(0, 0, 0, 0);  // at a light
      picker.pick(n, {u, x, y}, from, choices);
      int different = 0;
      for (int i = 0; i < n; ++i) {
        const auto one = picker.pick(u[i], {x[i], y[i]}, from.point(i));
        different += one.light != choices.light[i] || one.probability != choices.probability[i];
      }
      CHECK(different == 0);
    }
  }
}
