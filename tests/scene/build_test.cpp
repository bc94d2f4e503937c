// What a scene has once it is built.
#include "scene/build.h"

#include <doctest/doctest.h>

#include "math/sampler.h"
#include "support/memory_scene.h"

using namespace duet;

namespace {

std::unique_ptr<Scene> build(const std::string& content) {
  test::ReadResult r = test::read_scene("3.0.0", content);
  REQUIRE(r.scene);
  auto scene = build_scene(r.description(), {}, r.diagnostics);
  REQUIRE(scene);
  return scene;
}

const std::string kSky = "<emitter type='constant'/>";
const std::string kSun = "<emitter type='directional'/>";

}  // namespace

TEST_CASE("lights that are infinitely far away know where the scene is") {
  for (const std::string& light : {kSky, kSun}) {
    const auto scene =
        build("<shape type='sphere'><point name='center' x='9' y='-5' z='2'/></shape>" + light);
    REQUIRE(scene->lights.size() == 1);
    // Rays fill a disk of the size of the sphere around the box around the sphere.
    const int n = 20000;
    int hits = 0;
    for (int i = 0; i < n; ++i) {
      Sampler sampler(SampleSequence::independent, 1, 0, uint64_t(i));
      sampler.start_sample(0);
      const Point2f position = sampler.next_2d(), direction = sampler.next_2d();
      const auto e = scene->lights[0]->sample_emission(position, direction);
      REQUIRE(e);
      hits += scene->accel->occluded(e->ray);
    }
    CHECK(hits / double(n) == doctest::Approx(1 / 3.0).epsilon(0.05));
  }
}

TEST_CASE("lights around nothing emit finite rays") {
  for (const std::string& light : {kSky, kSun}) {
    const auto scene = build(light);
    const auto e = scene->lights[0]->sample_emission({0.3f, 0.4f}, {0.1f, 0.2f});
    REQUIRE(e);
    CHECK(is_finite(e->ray.origin));
    CHECK(is_finite(e->weight));
  }
}

TEST_CASE("bump maps can lie within one another, up to a number") {
  const auto messages = [](const std::string& bsdf) {
    test::ReadResult r = test::read_scene("3.0.0", "<shape type='sphere'>" + bsdf + "</shape>");
    REQUIRE_MESSAGE(r.scene, r.messages());
    const auto scene = build_scene(r.description(), {}, r.diagnostics);
    CHECK(bool(scene) == r.messages().empty());
    return r.messages();
  };
  const auto bumpy = [](const std::string& nested) {
    return "<bsdf type='bumpmap'><texture type='checkerboard'/>" + nested + "</bsdf>";
  };
  const auto blend = [](const std::string& nested) {
    return "<bsdf type='blendbsdf'>" + nested + nested + "</bsdf>";
  };
  const std::string twice = bumpy(bumpy("<bsdf type='diffuse'/>"));
  CHECK(messages(twice) == "");
  CHECK(messages(bumpy(blend(bumpy("<bsdf type='diffuse'/>")))) == "");
  const std::string deep = messages(bumpy(twice)), many = messages(blend(blend(twice)));
  CHECK_MESSAGE(deep.find("3 bump maps, normal maps and coatings lie over each other here; at most "
                          "2 can") != deep.npos,
                deep);
  CHECK_MESSAGE(
      many.find("8 bump maps, normal maps and coatings are mixed here; at most 6 can be") !=
          many.npos,
      many);
}

TEST_CASE("lights are chosen by the weights that the scene gives them") {
  // Two of a kind: without weights each has a probability of one half.
  const auto probability = [](const std::string& first, const std::string& second) {
    return build(first + second)->emission_picker.probability(0);
  };
  const std::string weight = "<float name='sampling_weight' value='3'/>";
  const auto point = [](const std::string& more) {
    return "<emitter type='point'>" + more + "</emitter>";
  };
  const auto area = [](const std::string& more) {
    return "<shape type='rectangle'><emitter type='area'>" + more + "</emitter></shape>";
  };
  CHECK(probability(point(""), point("")) == doctest::Approx(0.5));
  CHECK(probability(point(weight), point("")) == doctest::Approx(0.75));
  CHECK(probability(area(weight), area("")) == doctest::Approx(0.75));
}
