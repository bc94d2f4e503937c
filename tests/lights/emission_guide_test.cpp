#include "lights/emission_guide.h"

#include <doctest/doctest.h>

#include "lights/delta.h"
#include "lights/environment.h"
#include "lights/portal.h"
#include "math/sampler.h"
#include "math/statistics.h"

using namespace duet;

namespace {

const Point3f kCenter(2, -1, 5);
constexpr float kRadius = 3;

std::vector<std::unique_ptr<Light>> make_lights() {
  std::vector<std::unique_ptr<Light>> lights;
  lights.push_back(std::make_unique<ConstantEnvironment>(Spectrum(0.7f)));
  lights.push_back(
      std::make_unique<DirectionalEmitter>(Transform(Matrix4::rotate(40, 1, 2, 0)), Spectrum(2)));
  lights.push_back(std::make_unique<PointEmitter>(kCenter, Spectrum(1)));
  for (const auto& l : lights) l->surround(kCenter, kRadius);
  return lights;
}

EmissionSample emit(const Light& light, uint32_t i) {
  Sampler sampler(SampleSequence::independent, 5, 0, 0);
  sampler.start_sample(i);
  const Point2f position = sampler.next_2d(), direction = sampler.next_2d();
  return *light.sample_emission(position, direction);
}

LightPicker evenly(size_t lights) {
  return LightPicker(std::vector<float>(lights, 1.0f));
}

/// Rays that pass near a point that lies aside of the centre.
EmissionGuide guide_to(const std::vector<std::unique_ptr<Light>>& lights, const Point3f& at,
                       float most = INFINITY) {
  std::vector<EmissionGuide::Record> records;
  for (uint32_t light = 0; light < 2; ++light)
    for (uint32_t i = 0; i < 8000; ++i) {
      Sampler sampler(SampleSequence::independent, 6, light, 0);
      sampler.start_sample(i);
      const Vector3f from = -emit(*lights[light], i).ray.direction;
      const Point3f near = at + Vector3f(sampler.next_1d(), sampler.next_1d(), 0) * 0.2f;
      records.push_back({light, from, lights[light]->entered_sphere()->entry(from, near), 1});
    }
  return {lights, evenly(lights.size()), std::move(records), most};
}

}  // namespace

TEST_CASE("the numbers with which a ray enters the scene's sphere are found again") {
  const SceneSphere sphere(kCenter, kRadius);
  Sampler sampler(SampleSequence::independent, 9, 0, 0);
  for (uint32_t i = 0; i < 1000; ++i) {
    sampler.start_sample(i);
    const Vector3f wi = square_to_sphere(sampler.next_2d());
    const Point2f u = sampler.next_2d();
    const Ray ray = sphere.enter(wi, u);
    const Point2f found = sphere.entry(wi, ray.origin + ray.direction * (4 * sampler.next_1d()));
    CHECK(std::abs(found.x - u.x) < 2e-5f);
    CHECK(std::abs(found.y - u.y) < 2e-5f);
  }
}

TEST_CASE("guided rays have the density that is asked for on the way back") {
  const auto lights = make_lights();
  const Point3f at = kCenter + Vector3f(1, 0.5f, -0.8f);
  const EmissionGuide guide = guide_to(lights, at);
  for (uint32_t light = 0; light < 2; ++light) {
    INFO(light);
    int odd = 0, near = 0, near_unguided = 0;
    Moments mass;
    constexpr uint32_t n = 20000;
    for (uint32_t i = 0; i < n; ++i) {
      Sampler sampler(SampleSequence::independent, 7, 0, 0);
      sampler.start_sample(i);
      const Point2f position = sampler.next_2d(), direction = sampler.next_2d();
      const EmissionSample plain = *lights[light]->sample_emission(position, direction);
      const EmissionSample guided = *guide.emit(light, *lights[light], position, direction);
      const float factor = guided.density / plain.density;
      const Vector3f from = -guided.ray.direction;
      CHECK(dot(from, plain.ray.direction) == doctest::Approx(-1).epsilon(1e-6));
      CHECK(guided.weight[0] * guided.density == doctest::Approx(plain.weight[0] * plain.density));
      // Rounding may take a ray across the edge of a cell.
      const float back = guide.factor(light, *lights[light], from,
                                      guided.ray.origin + guided.ray.direction * 2.0f);
      odd += std::abs(back - factor) > 1e-4f * factor;
      mass.add(1 / double(factor));
      const auto distance = [&](const Ray& r) {
        const Vector3f d = at - r.origin;
        return length(d - r.direction * dot(d, r.direction));
      };
      near += distance(guided.ray) < 0.4f;
      near_unguided += distance(plain.ray) < 0.4f;
    }
    CHECK(odd < 20);
    // The mean of 1 / factor is the area of the disk in parts of itself.
    CHECK(std::abs(mass.mean() - 1) < 4 * mass.error());
    CHECK(mass.error() < 0.02);
    CHECK(near > 8 * near_unguided);
  }
}

// Two of three lights have records, as many each: an eighth of the choice is left to the third, and
// the others have more than a third.
TEST_CASE("weights count guided rays as no denser than they may") {
  const auto lights = make_lights();
  const Point3f at = kCenter + Vector3f(1, 0.5f, -0.8f);
  const EmissionGuide guide = guide_to(lights, at), counted = guide_to(lights, at, 3);
  const float chosen = 3 * guide.probability(0);
  CHECK(chosen == doctest::Approx(0.25 + 0.75 * 1.5));
  int limited = 0;
  for (uint32_t i = 0; i < 1000; ++i) {
    const EmissionSample plain = emit(*lights[0], i);
    const Point2f position{float(i % 32) / 32, float(i / 32) / 32};
    Sampler sampler(SampleSequence::independent, 5, 0, 0);
    sampler.start_sample(i);
    sampler.next_2d();
    const Point2f direction = sampler.next_2d();
    const EmissionSample a = *guide.emit(0, *lights[0], position, direction),
                         b = *counted.emit(0, *lights[0], position, direction);
    CHECK(a.ray.origin == b.ray.origin);
    CHECK(a.weight == b.weight);
    CHECK(b.density == doctest::Approx(std::min(a.density, 3 / chosen * plain.density)));
    limited += b.density < a.density;
    const Vector3f from = -a.ray.direction;
    CHECK(counted.factor(0, *lights[0], from, at) ==
          doctest::Approx(std::min(guide.factor(0, *lights[0], from, at), 3 / chosen)));
  }
  CHECK(limited > 100);
}

TEST_CASE("lights without numbers that a guide could choose are left alone") {
  const std::array<Point3f, 4> corners{Point3f(0, 0, 0), Point3f(1, 0, 0), Point3f(1, 1, 0),
                                       Point3f(0, 1, 0)};
  std::vector<std::unique_ptr<Light>> lights;
  lights.push_back(std::make_unique<PortalEnvironment>(
      std::make_unique<ConstantEnvironment>(Spectrum(1)), corners, 0.5f));
  lights[0]->surround(kCenter, kRadius);
  CHECK(!EmissionGuide::guided_numbers(*lights[0], {0, 0, 1}, kCenter));
  const EmissionGuide guide(lights, evenly(1), {{0, {0, 0, 1}, {0.5f, 0.5f}, 1}});
  for (uint32_t i = 0; i < 20; ++i) {
    Sampler sampler(SampleSequence::independent, 5, 0, 0);
    sampler.start_sample(i);
    const Point2f position = sampler.next_2d(), direction = sampler.next_2d();
    const auto plain = lights[0]->sample_emission(position, direction),
               guided = guide.emit(0, *lights[0], position, direction);
    REQUIRE(plain.has_value() == guided.has_value());
    if (!plain) continue;
    CHECK(guided->ray.origin == plain->ray.origin);
    CHECK(guided->density == plain->density);
    CHECK(guide.factor(0, *lights[0], -plain->ray.direction, kCenter) == 1);
  }
}

TEST_CASE("a guide chooses lights by the use of their rays") {
  const auto lights = make_lights();
  std::vector<EmissionGuide::Record> records;
  for (const uint32_t light : {2, 0, 2, 2})
    records.push_back({light, {0, 0, 1}, {0.5f, 0.5f}, light == 0 ? 1.5f : 0.5f});
  const float weights[] = {1, 2, 5};
  const EmissionGuide guide(lights, LightPicker(weights), records);
  // A quarter of the choice without a guide, and three quarters by the weights of the records.
  CHECK(guide.probability(0) == doctest::Approx(0.25 / 8 + 0.75 / 2));
  CHECK(guide.probability(1) == doctest::Approx(0.25 * 2 / 8));
  CHECK(guide.probability(2) == doctest::Approx(0.25 * 5 / 8 + 0.75 / 2));
  std::array<int, 3> found{};
  constexpr int kChoices = 4000;
  for (int i = 0; i < kChoices; ++i) {
    const auto pick = guide.pick((float(i) + 0.5f) / kChoices, {0.5f, 0.5f});
    CHECK(pick.probability == guide.probability(pick.light));
    ++found[pick.light];
  }
  for (uint32_t i = 0; i < 3; ++i)
    CHECK(std::abs(float(found[i]) - kChoices * guide.probability(i)) < 3);
  // Lights that begin no sub-paths without a guide begin none with one.
  const float without[] = {0, 2, 5};
  CHECK(EmissionGuide(lights, LightPicker(without), records).probability(0) == 0);
  // Without records, as without a guide.
  CHECK(EmissionGuide(lights, LightPicker(weights), {}).probability(2) == doctest::Approx(5 / 8.0));
}
