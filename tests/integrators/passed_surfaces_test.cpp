// Surfaces that light passes straight through: vertices of paths in Mitsuba, none in pbrt.
#include <doctest/doctest.h>

#include "support/pbrt_file.h"
#include "support/transport_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

/// A camera at 1.5 above a lamp at 1, over a diffuse disk; half of the light passes each of two
/// black disks between.
SceneDescription two_half_open_disks() {
  const TemporaryDirectory folder;
  return scene_of(read_pbrt_file(folder.write(
      "scene.pbrt",
      "LookAt 0 0 1.5 0 0 0 0 1 0\nCamera \"perspective\" \"float fov\" 1\n"
      "Film \"rgb\" \"integer xresolution\" 1 \"integer yresolution\" 1\n"
      "PixelFilter \"box\"\nIntegrator \"bdpt\" \"integer maxdepth\" 1\nWorldBegin\n"
      "LightSource \"point\" \"point3 from\" [0 0 1]\n"
      "Material \"diffuse\" \"rgb reflectance\" [.5 .5 .5]\nShape \"disk\" \"float radius\" .5\n"
      "Material \"diffuse\" \"rgb reflectance\" [0 0 0]\n"
      "Shape \"disk\" \"float height\" .5 \"float alpha\" .5\n"
      "Shape \"disk\" \"float height\" .6 \"float alpha\" .5\n")));
}

}  // namespace

TEST_CASE("surfaces that light passes straight through are no vertices in pbrt's scenes") {
  constexpr double kExpected = 0.5 / 3.14159265358979 / 16;
  const TransportScene scene(two_half_open_disks());
  CHECK(scene.scene->skips_passed_surfaces);
  for (const std::string method : {"volpath", "bdpt", "reuse", "ppm", "bpm", "vcm", "auto"}) {
    CAPTURE(method);
    const double mean = double(scene.render(method, {{"max_depth", "2"}}, 16384, 1).image.data[0]);
    CHECK(mean == doctest::Approx(kExpected).epsilon(0.03));
  }
}

TEST_CASE("what stops at surfaces that pbrt does not count says so") {
  const SceneDescription scene = two_half_open_disks();
  for (const std::string method : {"path", "direct", "volpath", "bdpt"}) {
    CAPTURE(method);
    IntegratorDescription integrator = scene.integrator;
    apply_override(integrator, {method, {}, {}});
    Diagnostics diagnostics;
    check_support(scene, integrator, diagnostics);
    CHECK(diagnostics.all().size() == (method == "path" || method == "direct" ? 1 : 0));
    CHECK(!diagnostics.has_errors());
  }
}

TEST_CASE("the weights of the thesis are refused where surfaces are no vertices") {
  const SceneDescription scene = two_half_open_disks();
  for (const std::string weights : {"exact", "thesis"}) {
    CAPTURE(weights);
    IntegratorDescription integrator = scene.integrator;
    apply_override(integrator, {"reuse", {{"weights", weights}}, {}});
    Diagnostics diagnostics;
    check_support(scene, integrator, diagnostics);
    CHECK(diagnostics.has_errors() == (weights == "thesis"));
  }
}

TEST_CASE("surfaces that light passes straight through count in Mitsuba's scenes") {
  SceneDescription description = two_half_open_disks();
  description.counts_passed_surfaces = true;
  const TransportScene scene(std::move(description));
  CHECK(!scene.scene->skips_passed_surfaces);
  // They stop light samples and connections.
  for (const char* method : {"path", "bdpt"})
    CHECK(scene.render(method, {{"max_depth", "20"}}, 256, 1).image.data[0] == 0);
}

TEST_CASE("pbrt-v3: lights without material are seen, and seen through") {
  const TemporaryDirectory folder;
  const TransportScene scene(scene_of(read_pbrt_file(folder.write(
      "scene.pbrt",
      "LookAt 0 0 5 0 0 0 0 1 0\nCamera \"perspective\" \"float fov\" 1\n"
      "Film \"image\" \"integer xresolution\" 1 \"integer yresolution\" 1\n"
      "Integrator \"volpath\" \"integer maxdepth\" 3\nWorldBegin\n"
      "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [2 2 2]\nMaterial \"none\"\n"
      "Shape \"disk\" \"float height\" 1\nAttributeEnd\n"
      "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [3 3 3]\nShape \"disk\"\n"
      "AttributeEnd\nWorldEnd\n"))));
  for (const std::string method : {"volpath", "bdpt", "reuse", "ppm", "vcm"}) {
    CAPTURE(method);
    const double mean = double(scene.render(method, {}, 1024, 1).image.data[0]);
    CHECK(mean == doctest::Approx(5).epsilon(0.01));
  }
}
