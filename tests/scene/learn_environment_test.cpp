#include "scene/learn_environment.h"

#include <doctest/doctest.h>

#include "math/statistics.h"
#include "support/transport_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

const std::string kConstantSky =
    "<emitter type='constant'><rgb name='radiance' value='1'/></emitter>";

std::string plate(const std::string& scale, const std::string& at) {
  return "<shape type='cube'><transform name='to_world'><scale value='" + scale +
         "'/><translate value='" + at + "'/></transform>" + grey("0.5") + "</shape>";
}

/// A room whose fourth wall has a window of 0.4 × 0.4, and the camera in it.
TransportScene room_with_window(const std::string& selection = "auto",
                                const std::string& things = "") {
  return TransportScene("<integrator type='path'><string name='light_selection' value='" +
                        selection + "'/><integer name='max_depth' value='4'/></integrator>" +
                        camera_xml("0.6, 0.7, 1.2", "-0.2, -1, 0.5", 12) + room_xml(grey("0.6")) +
                        plate("0.4, 0.02, 1", "-0.6, -1, 1") + plate("0.4, 0.02, 1", "0.6, -1, 1") +
                        plate("0.2, 0.02, 0.6", "0, -1, 0.6") +
                        plate("0.2, 0.02, 0.2", "0, -1, 1.8") + kConstantSky + things);
}

float density(const TransportScene& scene, const Point3f& from, const Vector3f& to) {
  return scene.scene->environment->pdf_direct(from, to).value;
}

Moments tiles(const TransportScene& scene, const std::string& method, int spp, uint64_t seeds) {
  Moments all;
  for (uint64_t seed = seeds; seed < seeds + 24; ++seed) {
    const Image image = scene.render(method, {{"max_depth", "4"}}, spp, seed).image;
    double sum = 0;
    for (const float v : image.data) sum += double(v);
    all.add(sum / double(image.data.size()));
  }
  return all;
}

}  // namespace

TEST_CASE("light samples learn where a room's window is, whatever the number of threads") {
  const TransportScene scene = room_with_window();
  const Point3f floor(0.3f, 0.4f, 0.01f);
  const Vector3f window = normalize(Point3f(0, -1, 1.4f) - floor);
  CHECK(density(scene, floor, window) > 10 * 0.25f * kInvPi);
  CHECK(density(scene, floor, {0, 0, 1}) < 0.26f * kInvPi);
  const TransportScene plain = room_with_window("power");
  CHECK(density(plain, floor, window) == 0.25f * kInvPi);
  const auto one = learn_environment(*plain.scene, {12, 12}, 1);
  const auto seven = learn_environment(*plain.scene, {12, 12}, 7);
  REQUIRE(one);
  REQUIRE(seven);
  const EnvironmentLight& sky = *plain.scene->environment;
  // Beside a lamp that brings more the noise of the sky is not what is seen.
  const TransportScene lit = room_with_window("auto", lamp_xml("0.5", "5"));
  CHECK(density(lit, floor, window) ==
        doctest::Approx(density(room_with_window("power", lamp_xml("0.5", "5")), floor, window)));
  CHECK(one->pdf(sky, floor, window).value == seven->pdf(sky, floor, window).value);
}

TEST_CASE("nothing is learned where the sky is open, or seen nowhere, or light is scattered") {
  const std::string camera = camera_xml("0, -6, 2", "0, 0, 0", 12);
  const std::string ball = sphere_xml("0, 0, 0", "1", grey("0.5"));
  const Point3f near(0, -1.01f, 0);
  for (const std::string& content :
       {camera + ball + kConstantSky, camera_xml("0, 0, 0", "1, 0, 0", 12) + ball + kConstantSky,
        camera + kConstantSky,
        camera + room_xml(grey("0.5")) + kConstantSky +
            sphere_xml("0, 0, 1", "0.3",
                       "<bsdf type='null'/><medium name='interior' type='homogeneous'/>")}) {
    const TransportScene scene(content);
    CHECK(density(scene, near, {0, 0, 1}) == 0.25f * kInvPi);
  }
}

// 24 images each. The standard error of the differences is 0.4 to 1 % of the mean, so that four of
// them would notice 4 %.
TEST_CASE("guided light samples bring the same light, with less noise") {
  const std::string mask =
      "<shape type='rectangle'><transform name='to_world'><scale value='0.3'/>"
      "<rotate x='1' angle='90'/><translate value='0, -0.95, 1.4'/></transform>"
      "<bsdf type='mask'><float name='opacity' value='0.5'/>" +
      grey("0.5") + "</bsdf></shape>";
  for (const std::string& things : {std::string(), mask}) {
    const TransportScene guided = room_with_window("auto", things),
                         plain = room_with_window("power", things);
    for (const std::string method : {"path", "bdpt", "vcm"}) {
      CAPTURE(method);
      CAPTURE(things);
      const Moments with = tiles(guided, method, 16, 100), without = tiles(plain, method, 16, 500);
      CAPTURE(with.mean());
      CAPTURE(with.error());
      CAPTURE(without.mean());
      CAPTURE(without.error());
      CHECK(welch_test(with.estimate(), without.estimate()).p > 1e-3);
      if (method == "path") CHECK(without.variance() > 1.5 * with.variance());
    }
  }
}
