// Directions of rays that start at lights within the scene, chosen by a guide.
#include <doctest/doctest.h>

#include "lights/delta.h"
#include "lights/emission_guide.h"
#include "math/sampler.h"
#include "math/statistics.h"
#include "support/lamp.h"

using namespace duet;
using test::analytic, test::fan, test::Lamp, test::mesh;

namespace {

const Matrix4 kPlace = Matrix4::translate(1, -2, 3) * Matrix4::rotate(70, 1, 2, 3);
const Matrix4 kStretched = kPlace * Matrix4::scale(-1.3, 0.7, 0.9) * Matrix4::rotate(25, 1, 1, 0);

struct GuidedLamp {
  std::string name;
  std::vector<std::unique_ptr<Light>> lights;  ///< one
  std::shared_ptr<Lamp> surface;               ///< whose light it was, or null
};

GuidedLamp point_lamp(const std::string& name, std::unique_ptr<Light> light) {
  GuidedLamp lamp{name, {}, nullptr};
  lamp.lights.push_back(std::move(light));
  return lamp;
}

GuidedLamp area_lamp(const std::string& name, Shape shape,
                     EmittingSide side = EmittingSide::shading) {
  auto surface = std::make_shared<Lamp>(std::move(shape), ColorSlot{{1, 2, 3}}, side);
  GuidedLamp lamp = point_lamp(name, std::move(surface->light));
  lamp.surface = surface;
  return lamp;
}

std::vector<GuidedLamp> make_lamps() {
  std::vector<GuidedLamp> lamps;
  lamps.push_back(
      point_lamp("point", std::make_unique<PointEmitter>(Point3f(1, 2, 3), Spectrum(2))));
  for (const double cutoff : {0.01, 0.6, 2.0})
    lamps.push_back(point_lamp("spot " + std::to_string(cutoff),
                               std::make_unique<SpotEmitter>(Transform(kStretched), Spectrum(2),
                                                             cutoff, 0.9 * cutoff, nullptr)));
  lamps.push_back(area_lamp("sphere", analytic(ShapeKind::sphere, kPlace)));
  lamps.push_back(area_lamp("disk", analytic(ShapeKind::disk, kStretched)));
  lamps.push_back(area_lamp("parallelogram", mesh(make_rectangle(), kStretched)));
  return lamps;
}

struct Numbers {
  Point2f position, direction;
  explicit Numbers(uint32_t i) {
    Sampler sampler(SampleSequence::independent, 5, 0, 0);
    sampler.start_sample(i);
    position = sampler.next_2d(), direction = sampler.next_2d();
  }
};

/// A guide to directions near the one that the light makes of these numbers.
EmissionGuide guide_near(const GuidedLamp& lamp, const Point2f& numbers) {
  std::vector<EmissionGuide::Record> records;
  for (uint32_t i = 0; i < 2000; ++i) {
    const Point2f u = Numbers(i).position;
    records.push_back({0, {0, 0, 1}, {numbers.x + 0.05f * u.x, numbers.y + 0.05f * u.y}, 1});
  }
  const float one[] = {1};
  return {lamp.lights, LightPicker(one), std::move(records)};
}

}  // namespace

TEST_CASE("the numbers of an emitted direction are found again") {
  for (const GuidedLamp& lamp : make_lamps()) {
    CAPTURE(lamp.name);
    int checked = 0;
    for (uint32_t i = 0; i < 2000; ++i) {
      const Numbers u(i);
      const auto e = lamp.lights[0]->sample_emission(u.position, u.direction);
      if (!e) continue;  // black at the rim of a spot
      const auto found = lamp.lights[0]->direction_numbers(e->ray.direction);
      REQUIRE(found);
      ++checked;
      // Close to the axis of a spot and the rim of a hemisphere a direction says less about them.
      const float tolerance = std::min(u.direction.x, 1 - u.direction.x) < 0.01f ||
                                      std::min(u.direction.y, 1 - u.direction.y) < 0.01f
                                  ? 0.05f
                                  : 2e-3f;
      CHECK(std::abs(found->x - u.direction.x) < tolerance);
      CHECK(std::abs(found->y - u.direction.y) < tolerance);
      CHECK(std::min(found->x, found->y) >= 0);
      CHECK(std::max(found->x, found->y) <= 1);
    }
    CHECK(checked > 1800);
  }
}

TEST_CASE("directions of lights whose normals vary are not guided") {
  const auto numbers = [](const GuidedLamp& lamp) {
    return lamp.lights[0]->direction_numbers({0, 0, 1});
  };
  CHECK(!numbers(area_lamp("fan", mesh(fan(), kPlace))));
  CHECK(!numbers(area_lamp("two sides", mesh(make_rectangle(), kPlace), EmittingSide::both)));
  CHECK(!numbers(area_lamp("inside", analytic(ShapeKind::sphere, kPlace, true))));
  CHECK(!numbers(area_lamp("ellipsoid", analytic(ShapeKind::sphere, kStretched))));
  CHECK(!numbers(area_lamp("cylinder", analytic(ShapeKind::cylinder, kPlace))));
}

// 1 / factor has the mean one: the share of the directions that there are.
TEST_CASE("guided directions have the density that is asked for on the way back") {
  for (const GuidedLamp& lamp : make_lamps()) {
    CAPTURE(lamp.name);
    const Light& light = *lamp.lights[0];
    const EmissionGuide guide = guide_near(lamp, {0.4f, 0.6f});
    int odd = 0, near = 0;
    Moments mass;
    constexpr uint32_t n = 10000;
    for (uint32_t i = 0; i < n; ++i) {
      const Numbers u(i);
      const auto e = guide.emit(0, light, u.position, u.direction);
      if (!e) {
        mass.add(0);
        continue;
      }
      const Vector3f& w = e->ray.direction;
      const Point2f numbers = *light.direction_numbers(w);
      const auto plain = light.sample_emission(u.position, numbers);
      if (!plain) continue;
      const float factor = guide.factor(0, light, -w, e->ray.origin + w);
      // Rounding may take a direction across the edge of a cell.
      odd += std::abs(e->density - factor * plain->density) > 2e-3f * e->density;
      for (int k = 0; k < 3; ++k)
        CHECK(e->weight[k] * e->density ==
              doctest::Approx(plain->weight[k] * plain->density).epsilon(0.01));
      mass.add(1 / double(factor));
      near += std::abs(numbers.x - 0.425f) < 0.03f && std::abs(numbers.y - 0.625f) < 0.03f;
    }
    CHECK(odd < 30);
    CHECK(std::abs(mass.mean() - 1) < 4 * mass.error() + 0.01);
    CHECK(mass.error() < 0.03);
    CHECK(near > 7 * int(n) / 10);
  }
}
