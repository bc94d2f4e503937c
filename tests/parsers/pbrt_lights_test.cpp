// What the lights of pbrt files become.
#include <doctest/doctest.h>

#include <vector>

#include "pbrt/writer.h"
#include "support/files.h"
#include "support/pbrt_file.h"

using namespace duet;
using namespace duet::test;

namespace {

PbrtFile world(const std::string& text, bool v3 = false) {
  const TemporaryDirectory folder;
  return read_pbrt_file(folder.write("scene.pbrt", "Camera \"perspective\" Film \"" +
                                                       std::string(v3 ? "image" : "rgb") +
                                                       "\"\nWorldBegin\n" + text + "\n"));
}

template <class Model>
Model only_light(const PbrtFile& file) {
  REQUIRE_MESSAGE(file.scene, file.messages);
  CHECK_MESSAGE(file.messages.empty(), file.messages);
  REQUIRE(file.scene->lights.size() == 1);
  return std::get<Model>(file.scene->lights[0].model);
}

}  // namespace

TEST_CASE("pbrt spot lights fade by t⁴ in v3, by t²(3 − 2t) in v4") {
  const std::string spot =
      "LightSource \"spot\" \"float coneangle\" 60 \"float conedeltaangle\" 60";
  const PbrtFile v3 = world(spot, true);
  CHECK(only_light<SpotLight>(v3).falloff == SpotFalloff::quartic);
  CHECK(only_light<SpotLight>(world(spot)).falloff == SpotFalloff::smooth);
  // pbrt-v4 does not have it.
  CHECK(pbrt::write_pbrt(*v3.scene).losses ==
        std::vector<std::string>{"the edge of a spot light is t²(3 − 2t), not t⁴ as in pbrt-v3"});
  CHECK(std::get<SpotLight>(v3.scene->lights[0].model).losses().size() == 1);
}

TEST_CASE("pbrt lights do not move: they stand where their way begins") {
  const std::string away = "ActiveTransform EndTime\nTranslate 0 0 40\nActiveTransform All\n";
  for (const bool v3 : {false, true})
    for (const std::string type : {"point", "spot", "distant", "infinite"}) {
      CAPTURE(type);
      const std::string light = "LightSource \"" + type + "\"\n";
      const PbrtFile moving = world("Translate 1 2 3\n" + away + light + "Shape \"sphere\"", v3);
      REQUIRE_MESSAGE(moving.scene, moving.messages);
      CHECK_MESSAGE(
          moving.messages.find("7:1: warning: lights do not move in pbrt") != moving.messages.npos,
          moving.messages);
      const LightDescription& l = moving.scene->lights.at(0);
      CHECK(l.motion.empty());
      CHECK(l.to_world == world("Translate 1 2 3\n" + light, v3).scene->lights.at(0).to_world);
      // Shapes do, and with them the lights that they are.
      CHECK_FALSE(moving.scene->shapes.at(0).motion.empty());
    }
}

TEST_CASE("pbrt writer: a light that moves stands still as the shutter opens") {
  SceneDescription d = scene_of(world("LightSource \"point\" \"point3 from\" [1 2 3]"));
  d.lights[0].motion = Motion({{0, Matrix4{}}, {1, Matrix4::translate(0, 0, 8)}});
  d.sensors.at(0).shutter = {0.25, 1};
  const pbrt::PbrtText written = pbrt::write_pbrt(d);
  CHECK(written.losses == std::vector<std::string>{
                              "lights do not move: they stand as they do when the shutter opens"});
  CHECK_MESSAGE(written.text.find("\"point3 from\" [1 2 5]") != std::string::npos, written.text);
  CHECK(written.text.find("ActiveTransform") == std::string::npos);
}

TEST_CASE("pbrt-v4: a power or illuminance that is not above zero is as none") {
  const auto intensity = [](const std::string& more) {
    return only_light<PointLight>(world("LightSource \"point\" \"rgb I\" [2 4 8] " + more))
        .intensity;
  };
  CHECK(intensity("\"float power\" -1") == Spectrum(2, 4, 8));
  CHECK(intensity("\"float power\" 0") == Spectrum(2, 4, 8));
  CHECK(intensity("\"float power\" 1").r < 1);
  const auto irradiance = [](const std::string& more) {
    return only_light<DirectionalLight>(world("LightSource \"distant\" " + more)).irradiance;
  };
  CHECK(irradiance("\"float illuminance\" -1") == Spectrum(1.0f));
  CHECK(irradiance("\"float illuminance\" 0") == Spectrum(1.0f));
  CHECK(irradiance("\"float illuminance\" 3") == Spectrum(3.0f));
  for (const std::string value : {"-1", "0"}) {
    const std::string power = "\"float power\" " + value;
    CHECK(only_light<SpotLight>(world("LightSource \"spot\" " + power)).intensity ==
          Spectrum(1.0f));
    CHECK(
        only_light<ConstantLight>(world("LightSource \"infinite\" \"float illuminance\" " + value))
            .radiance == Spectrum(1.0f));
    const PbrtFile area = world("AreaLightSource \"diffuse\" " + power + " Shape \"sphere\"");
    REQUIRE_MESSAGE(area.scene, area.messages);
    CHECK(area.scene->shapes.at(0).emission->radiance == ColorInput(Spectrum(1.0f)));
  }
}

TEST_CASE("pbrt-v4 refuses lights of negative colours, and scales that are colours") {
  const auto refused = [](const std::string& light, const std::string& message) {
    CAPTURE(light);
    const PbrtFile f = world(light);
    CHECK_FALSE(f.scene.has_value());
    CHECK_MESSAGE(f.messages.find(message) != f.messages.npos, f.messages);
  };
  refused("LightSource \"infinite\" \"rgb L\" [-1 1 1]",
          "3:24: error: parameter \"L\" has a negative component");
  refused("AreaLightSource \"diffuse\" \"rgb L\" [1 1 -1] Shape \"sphere\"",
          "3:27: error: parameter \"L\" has a negative component");
  refused("LightSource \"point\" \"rgb scale\" [2 1 1]",
          "3:21: error: parameter \"scale\" must be of type float, not rgb");
  refused("AreaLightSource \"diffuse\" \"rgb scale\" [2 1 1] Shape \"sphere\"",
          "3:27: error: parameter \"scale\" must be of type float, not rgb");
  // v3 has both.
  CHECK(world("LightSource \"infinite\" \"rgb L\" [-1 1 1] \"rgb scale\" [2 1 1]", true)
            .scene.has_value());
}
