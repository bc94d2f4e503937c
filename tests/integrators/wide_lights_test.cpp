#include "integrators/wide_lights.h"

#include <doctest/doctest.h>

#include "math/hash.h"
#include "support/lamp.h"
#include "transport/light_choice.h"

using namespace duet;

namespace {

/// 72 triangles whose shading normals lean to all sides of their own.
TriangleMesh rough_ground() {
  constexpr int kCells = 6;
  TriangleMesh m;
  const auto noise = [](int x, int y, uint64_t which) {
    return float(hash_combine(uint64_t(x * 31 + y), which) >> 40) * 0x1p-24f - 0.5f;
  };
  for (int y = 0; y <= kCells; ++y)
    for (int x = 0; x <= kCells; ++x) {
      m.positions.push_back({float(x), float(y), noise(x, y, 1)});
      m.normals.push_back(normalize(Normal3f(2 * noise(x, y, 2), 2 * noise(x, y, 3), 0.3f)));
    }
  for (int y = 0; y < kCells; ++y)
    for (int x = 0; x < kCells; ++x) {
      const uint32_t a = uint32_t(y * (kCells + 1) + x), b = a + kCells + 1;
      m.triangles.push_back({a, a + 1, b});
      m.triangles.push_back({a + 1, b + 1, b});
    }
  return m;
}

void add_lamp(Scene& scene, const Shape& shape, EmittingSide side, LightSelection selection) {
  const ColorSlot radiance{{1, 2, float(1 + scene.lights.size())}};
  scene.lights.push_back(std::make_unique<AreaLight>(shape, radiance, side, selection));
}

/// Compares light samples of a batch of points with those that are taken one by one. Some points
/// see nothing that shines, unless lamps shine to all sides.
void check_samples(const Scene& scene, bool from_all_sides) {
  const WideLights lights(scene);
  auto points = std::make_unique<WidePoints>();
  auto numbers = std::make_unique<WideNumbers>();
  auto samples = std::make_unique<WideLightSamples>();
  auto choice = std::make_unique<LightChoices>();
  Sampler sampler(SampleSequence::independent, 5, 0, 0);
  for (int i = 0; i < kBatch; ++i) {
    sampler.start_sample(uint32_t(i));
    const Point2f a = sampler.next_2d(), b = sampler.next_2d(), u = sampler.next_2d();
    // Above and below.
    points->position.set(i, 8 * a.x - 1, 8 * a.y - 1, 6 * b.x - 3);
    numbers->light_x[i] = u.x, numbers->light_y[i] = u.y, numbers->light_choice[i] = b.y;
  }
  lights.sample(kBatch, *points, *numbers, *choice, *samples);
  int seen = 0;
  for (int i = 0; i < kBatch; ++i) {
    CAPTURE(i);
    const ChosenLight one =
        choose_light(scene, points->position.point(i), {numbers->light_x[i], numbers->light_y[i]},
                     numbers->light_choice[i]);
    CHECK((samples->pdf[i] > 0) == one.sample.has_value());
    if (!one.sample || !(samples->pdf[i] > 0)) continue;
    ++seen;
    CHECK(samples->wi.vector(i) == one.sample->wi);
    CHECK(samples->target.point(i) == one.sample->target);
    CHECK(samples->weight.x[i] == one.sample->weight.r);
    CHECK(samples->weight.z[i] == one.sample->weight.b);
    CHECK(samples->pdf[i] == one.sample->pdf.value * one.probability);
    CHECK(samples->probability[i] == one.probability);
    CHECK(samples->emission[i] == one.sample->emission);
  }
  CHECK(seen > kBatch / 8);
  CHECK((seen == kBatch) == from_all_sides);
}

}  // namespace

TEST_CASE("light samples of meshes in batches are those that are taken one by one") {
  const Shape rough = test::mesh(rough_ground(), Matrix4());
  const Shape cube = test::mesh(make_cube(), Matrix4::rotate(35, 3, 1, 2));
  for (const LightSelection selection : {LightSelection::automatic, LightSelection::power})
    for (const EmittingSide side :
         {EmittingSide::shading, EmittingSide::geometric, EmittingSide::both}) {
      CAPTURE(int(selection));
      CAPTURE(int(side));
      Scene scene;
      add_lamp(scene, rough, side, selection);
      check_samples(scene, side == EmittingSide::both);
      add_lamp(scene, cube, side, selection);
      scene.direct_picker = DirectPicker(scene.lights, std::vector<double>{1, 2}, 10, selection);
      check_samples(scene, side == EmittingSide::both);
    }
}
