#include "integrators/learn_emission.h"

#include "integrators/importance_map.h"
#include "math/statistics.h"
#include "support/transport_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

/// The room on a plain `size` in half its side, a camera within the room, and what stands there.
TransportScene on_plain(const std::string& light, const std::string& size = "40",
                        const std::string& things = "") {
  return TransportScene(camera_xml("0, -0.8, 1", "0, 1, 0.6", 12) + room_xml(grey("0.6")) +
                        "<shape type='rectangle'><transform name='to_world'><scale value='" + size +
                        "'/><translate z='-0.05'/></transform>" + grey("0.4") + "</shape>" + light +
                        things);
}
std::string sun(const std::string& direction) {
  return "<emitter type='directional'><vector name='direction' value='" + direction +
         "'/><rgb name='irradiance' value='5'/></emitter>";
}
const std::string kSky = "<emitter type='constant'><rgb name='radiance' value='1'/></emitter>";
/// Into the open side of the room.
const std::string kSun = sun("0.3, 1, -0.6");
/// Lamps high above the room and the plain.
const std::string kBulb =
    "<emitter type='point'><point name='position' value='-1, -4, 6'/><rgb "
    "name='intensity' value='100'/></emitter>";
const std::string kGlobe = sphere_xml(
    "-1, -4, 6", "0.1", "<emitter type='area'><rgb name='radiance' value='3000'/></emitter>");
const std::string kPanel =
    "<shape type='rectangle'><transform name='to_world'><scale value='0.1'/>"
    "<lookat origin='-1, -4, 6' target='0, 0, 0' up='0, 0, 1'/></transform>"
    "<emitter type='area'><rgb name='radiance' value='3000'/></emitter></shape>";
/// One near the room among a hundred that are far away from it.
std::string chain() {
  std::string all = kBulb;
  for (int i = 0; i < 100; ++i)
    all += "<emitter type='point'><point name='position' value='" + std::to_string(i % 10) +
           ", 11, 0.1'/><rgb name='intensity' value='100'/></emitter>";
  return all;
}
const std::string kBall = sphere_xml("0.3, 0.3, 0.4", "0.4", "<bsdf type='dielectric'/>");

LightPassPlan plan(int threads = 2) {
  LightPassPlan p;
  p.set.light_samples = true;
  p.max_depth = 5;
  p.threads = threads;
  return p;
}

using Parameters = TransportScene::Parameters;

/// Means of images of several seeds.
Moments means(const TransportScene& scene, const std::string& method, const Parameters& parameters,
              int spp, uint64_t first_seed) {
  Moments all;
  for (uint64_t seed = first_seed; seed < first_seed + 32; ++seed) {
    const Image image = scene.render(method, parameters, spp, seed).image;
    double sum = 0;
    for (const float v : image.data) sum += double(v);
    all.add(sum / double(image.data.size()));
  }
  return all;
}

}  // namespace

TEST_CASE("rays enter where the camera looks, whatever the number of threads") {
  const TransportScene scene = on_plain(kSun);
  const auto guide = learn_emission(*scene.scene, {12, 12}, plan(1));
  const auto same = learn_emission(*scene.scene, {12, 12}, plan(7));
  REQUIRE(guide);
  REQUIRE(same);
  const Vector3f from = normalize(Vector3f(-0.3f, -1, 0.6f));
  // The floor of the room's open side, and the plain behind the room.
  const float inside = guide->factor(0, *scene.scene->lights[0], from, {0.1f, -0.5f, 0}),
              outside = guide->factor(0, *scene.scene->lights[0], from, {9, 20, 0});
  CHECK(inside > 100 * outside);
  CHECK(outside == doctest::Approx(0.25).epsilon(0.05));
  CHECK(same->factor(0, *scene.scene->lights[0], from, {0.1f, -0.5f, 0}) == inside);
}

TEST_CASE("there is no guide where it does not help") {
  // A lamp; a scene that is no larger than what the camera sees; no light; media.
  CHECK(!learn_emission(*on_plain(lamp_xml("0.3", "5")).scene, {12, 12}, plan()));
  CHECK(!learn_emission(*on_plain("").scene, {12, 12}, plan()));
  const TransportScene ball(camera_xml("0, -6, 0", "0, 0, 0", 12) +
                            sphere_xml("0, 0, 0", "1", grey("0.9")) +
                            sphere_xml("0, 0, 0", "0.5", grey("0.9")) + kSky);
  CHECK(!learn_emission(*ball.scene, {12, 12}, plan()));
  const TransportScene fog =
      on_plain(kSun, "40",
               sphere_xml("0, 0, 1", "0.3",
                          "<bsdf type='null'/><medium name='interior' type='homogeneous'/>"));
  CHECK(!learn_emission(*fog.scene, {12, 12}, plan()));
}

// 32 images each. The standard errors of the differences are printed if they fail; that of the sun
// with bdpt is 0.5 % of the mean, so that four of them would notice 2 %.
TEST_CASE("guided light sub-paths bring the same light, with less noise") {
  struct Case {
    std::string name;
    TransportScene scene;
    std::string method;
    double least_gain;  ///< of the variance of the mean
  };
  const Case cases[] = {{"sun, ppm", on_plain(kSun, "12"), "ppm", 8},
                        {"sun, ptracer", on_plain(kSun, "12"), "ptracer", 8},
                        {"sun and glass, vcm", on_plain(kSun, "12", kBall), "vcm", 3},
                        {"sky, ptracer", on_plain(kSky, "12"), "ptracer", 3},
                        {"sky and sun, bpm", on_plain(kSky + kSun, "12"), "bpm", 3},
                        {"point, ptracer", on_plain(kBulb, "12"), "ptracer", 8},
                        {"point and glass, vcm", on_plain(kBulb, "12", kBall), "vcm", 3},
                        {"sphere, bpm", on_plain(kGlobe, "12"), "bpm", 8},
                        {"panel and glass, bdpt", on_plain(kPanel, "12", kBall), "bdpt", 1},
                        {"many points, ptracer", on_plain(chain(), "12"), "ptracer", 3}};
  for (const Case& c : cases) {
    CAPTURE(c.name);
    // Without roulette, the noise of which guides do not change.
    Parameters p{{"max_depth", "5"}, {"light_paths", "4"}, {"rr_depth", "5"}};
    if (c.method != "ptracer" && c.method != "bdpt") p.push_back({"radius", "0.05"});
    const Moments guided = means(c.scene, c.method, p, 8, 100);
    p.push_back({"guide_emission", "false"});
    const Moments plain = means(c.scene, c.method, p, 8, 500);
    CAPTURE(guided.mean());
    CAPTURE(guided.error());
    CAPTURE(plain.mean());
    CAPTURE(plain.error());
    CHECK(welch_test(guided.estimate(), plain.estimate()).p > 1e-3);
    CHECK(plain.variance() > c.least_gain * guided.variance());
  }
}

TEST_CASE("importance is where camera sub-paths have been, on the side that they came from") {
  const TransportScene scene = on_plain(kSky);
  const ImportanceMap map(trace_importons(*scene.scene, {12, 12}, 32, 4, {}, 2));
  const Vector3f up(0, 0, 1);
  CHECK(map({0, 0.5f, 0}, up) > 0);
  CHECK(map({0, 0.5f, 0}, -up) == 0);
  CHECK(map({0, 1, 0.8f}, {0, -1, 0}) > 0);
  CHECK(map({0, 1, 0.8f}, {0, 1, 0}) == 0);
  CHECK(map({30, 30, -0.05f}, up) == 0);
  // In sum over the surfaces in front of the camera it is the number of vertices that were seen
  // there, or somewhat more, since boxes overlap: of 1,024 sub-paths one each on floor and back
  // wall.
  double floor = 0;
  for (int i = 0; i < 200; ++i)
    for (int j = 0; j < 200; ++j)
      floor +=
          double(map({-1 + (float(i) + 0.5f) / 100, -1 + (float(j) + 0.5f) / 100, 0}, up)) / 1e4;
  CHECK(floor > 300);
  CHECK(floor < 4000);
}
