// Direct light with what mirrors show of it: pbrt-v3's directlighting and whitted.
#include <doctest/doctest.h>

#include "support/pbrt_file.h"
#include "support/transport_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

/// A camera above a mirror, and over both a diffuse disk that a lamp between them lights: in the
/// middle of the image it is seen from below.
TransportScene mirrored_disk(const std::string& integrator, const std::string& more = "") {
  const TemporaryDirectory folder;
  return TransportScene(scene_of(read_pbrt_file(folder.write(
      "scene.pbrt",
      "LookAt 0 0 1.5 0 0 0 0 1 0\nCamera \"perspective\" \"float fov\" 1\n"
      "Film \"image\" \"integer xresolution\" 1 \"integer yresolution\" 1\n"
      "PixelFilter \"box\"\n" +
          integrator + "\nWorldBegin\nLightSource \"point\" \"point from\" [0 0 1]\n" + more +
          "Material \"mirror\" \"rgb Kr\" [.9 .9 .9]\nShape \"disk\" \"float radius\" 3\n"
          "Material \"matte\" \"rgb Kd\" [.5 .5 .5]\n"
          "Shape \"disk\" \"float height\" 2 \"float radius\" 3\nWorldEnd\n"))));
}

double brightness(const TransportScene& scene, const std::string& method,
                  const TransportScene::Parameters& parameters) {
  return double(scene.render(method, parameters, 256, 1).image.data[0]);
}

}  // namespace

TEST_CASE("direct light: mirrors show it, and nothing comes back to what is not smooth") {
  constexpr double kPiD = 3.14159265358979, kDirect = 0.9 * 0.5 / kPiD;
  for (const char* name : {"directlighting", "whitted"}) {
    const TransportScene scene = mirrored_disk("Integrator \"" + std::string(name) + "\"");
    const auto& path = std::get<PathIntegratorDescription>(scene.integrator.method);
    CHECK(path.only_specular);
    CHECK(path.max_depth == 6);
    CHECK(brightness(scene, "path", {{"only_specular", "true"}}) ==
          doctest::Approx(kDirect).epsilon(0.01));
    // Light from the disk to the mirror and back is left out by it alone.
    CHECK(brightness(scene, "path", {{"only_specular", "false"}}) > 1.02 * kDirect);
    // Two segments end on the disk, before the lamp.
    CHECK(brightness(scene, "path", {{"only_specular", "true"}, {"max_depth", "2"}}) == 0);
  }
}

TEST_CASE("direct light: passing surfaces do not count, media are not seen") {
  const TransportScene scene = mirrored_disk(
      "Integrator \"directlighting\" \"integer maxdepth\" 2",
      "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\"\nAttributeBegin\n"
      "MediumInterface \"fog\" \"\"\nMaterial \"none\"\n"
      "Shape \"disk\" \"float height\" .5\nShape \"disk\" \"float height\" .6\nAttributeEnd\n");
  CHECK(scene.scene->media.empty());
  CHECK(brightness(scene, "path", {{"only_specular", "true"}}) ==
        doctest::Approx(0.9 * 0.5 / 3.14159265358979).epsilon(0.01));
}
