// That methods are refused what they cannot render, and that `auto` never takes such a method.
#include "integrators/method_rules.h"

#include "integrators/method_choice.h"
#include "support/transport_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

const char* const kFromLights[] = {"ptracer", "bdpt", "reuse", "ppm", "bpm", "vcm"};
const std::string kHair = "<bsdf type='hair'/>";
const std::string kFogCube =
    "<medium type='homogeneous' id='fog'><float name='sigma_t' value='0.3'/></medium>"
    "<shape type='cube'><transform name='to_world'><scale value='5'/></transform>"
    "<bsdf type='null'/><ref id='fog' name='interior'/></shape>";

/// A strand of a material, a point light and a ball of glass.
std::string strand(const TemporaryDirectory& folder, const std::string& bsdf) {
  return camera_xml("0, -3, 1", "0, 0, 1", 8) +
         "<shape type='linearcurve'><string name='filename' value='" +
         folder.write("strand.txt", "0 0 0 0.1\n0 0 1 0.1\n") + "'/>" + bsdf + "</shape>" +
         "<emitter type='point'><point name='position' value='0, 0, 1.9'/></emitter>" +
         sphere_xml("-0.4, 0, 0.6", "0.4", "<bsdf type='dielectric'/>");
}

SceneDescription read(const TemporaryDirectory& folder, const std::string& content) {
  Diagnostics diagnostics;
  auto scene = read_mitsuba(
      folder.write("scene.xml", "<scene version='3.0.0'>" + content + "</scene>"), {}, diagnostics);
  REQUIRE(scene);
  return std::move(scene->description);
}

/// What the command line says of a method; "" if nothing.
std::string refusal(const SceneDescription& scene, const std::string& method) {
  IntegratorDescription d;
  apply_override(d, {method, {}, {}});
  Diagnostics diagnostics;
  check_support(scene, d, diagnostics);
  return diagnostics.error_count() == 0 ? "" : diagnostics.all()[0].to_string();
}

}  // namespace

TEST_CASE(
    "methods that follow light from its source refuse surfaces that it cannot be followed "
    "through") {
  const TemporaryDirectory folder;
  for (const bool fog : {false, true}) {
    const SceneDescription scene = read(folder, strand(folder, kHair) + (fog ? kFogCube : ""));
    for (const std::string method : kFromLights) {
      const std::string message = refusal(scene, method);
      CAPTURE(method);
      CAPTURE(message);
      CHECK(message.find("scene.xml:1:") != message.npos);
      const bool has_no_photons = fog && (method == "ppm" || method == "bpm");
      CHECK(message.find(has_no_photons ? "participating media"
                                        : "cannot follow light through curves") != message.npos);
    }
    for (const char* method : {"path", "volpath", "direct", "auto", "depth"})
      CHECK(refusal(scene, method) == "");
  }
  const SceneDescription opaque = read(folder, strand(folder, grey("0.5")));
  for (const char* method : kFromLights) CHECK(refusal(opaque, method) == "");
}

TEST_CASE("auto takes no method that the command line refuses") {
  const TemporaryDirectory folder;
  const auto chosen = [&](const std::string& content) {
    const TransportScene s(folder, content);
    const MethodChoice c = choose_method(*s.scene, {}, {s.layout.full, 4, 1});
    const SceneLimits limits{s.scene->features.media > 0, s.scene->features.one_way_surfaces > 0};
    CHECK(find_obstacle(limits, c.method) == Obstacle::none);
    return c.reason.substr(0, c.reason.find_first_of(": "));
  };
  // Light that comes through the glass needs sub-paths from the light, which the strand forbids.
  CHECK(chosen(strand(folder, kHair) + kFogCube) == "volpath");
  CHECK(chosen(strand(folder, kHair)) == "path");
  CHECK(chosen(strand(folder, grey("0.5")) + kFogCube) != "volpath");
}

TEST_CASE("some methods need a sensor that can be connected with light sub-paths") {
  const SceneLimits meter{.connectible = false};
  for (const auto& [name, refused] : {std::pair{"ptracer", true},
                                      {"reuse", true},
                                      {"bdpt", false},
                                      {"vcm", false},
                                      {"path", false}}) {
    IntegratorDescription d;
    apply_override(d, {name, {}, {}});
    CHECK((find_obstacle(meter, d.method) == Obstacle::sensor) == refused);
    CHECK(find_obstacle({}, d.method) == Obstacle::none);
  }
}
