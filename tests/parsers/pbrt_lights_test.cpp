// What the lights of pbrt files become.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "image/image_io.h"
#include "pbrt/writer.h"
#include "scene/build.h"
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

TEST_CASE("pbrt spot lights fade from the amount of a negative difference of angles on") {
  const auto full = [](const std::string& delta) {
    return only_light<SpotLight>(world("LightSource \"spot\" \"float coneangle\" 20 \"float "
                                       "conedeltaangle\" " +
                                       delta))
        .beam_width;
  };
  CHECK(full("5") == 15);
  CHECK(full("20") == 0);
  CHECK(full("30") == 10);
  CHECK(full("50") == 20);
}

TEST_CASE("pbrt-v4 has no power of lights that are infinitely far away") {
  for (const std::string light : {"infinite", "distant"}) {
    const PbrtFile file = world("LightSource \"" + light + "\" \"float power\" 5");
    CHECK(file.scene);
    CHECK(file.messages.find("\"" + light + "\" has no parameter \"power\"") != std::string::npos);
  }
}

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

TEST_CASE(
    "pbrt-v3: \"from\" of a point light is in the world; spots and v4 have it in their own space") {
  const auto place = [](const std::string& light, bool v3) {
    const PbrtFile f = world("Translate 1 2 3\nRotate 90 0 0 1\nScale 2 2 2\nLightSource \"" +
                                 light + "\" \"point3 from\" [1 0 0]",
                             v3);
    REQUIRE_MESSAGE(f.scene, f.messages);
    const Matrix4& m = f.scene->lights.at(0).to_world;
    return std::vector<long>{std::lround(m[0][3]), std::lround(m[1][3]), std::lround(m[2][3])};
  };
  CHECK(place("point", true) == std::vector<long>{2, 2, 3});
  CHECK(place("point", false) == std::vector<long>{1, 4, 3});
  for (const bool v3 : {false, true}) CHECK(place("spot", v3) == std::vector<long>{1, 4, 3});
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

TEST_CASE("pbrt-v3: images of lights are taken as they are, and a projector may have none") {
  const TemporaryDirectory folder;
  write_display_image(folder.path("map.png"), 1, 2, 3, {128, 128, 128, 255, 255, 255});
  const auto lights = [&](const std::string& film, const std::string& name) {
    const std::string image = " \"string " + name + "\" \"map.png\"\n";
    return scene_of(read_pbrt_file(
        folder.write("scene.pbrt", "Camera \"perspective\" Film \"" + film +
                                       "\"\nWorldBegin\nLightSource \"infinite\"" + image +
                                       "LightSource \"projection\"" + image)));
  };
  const SceneDescription v3 = lights("image", "mapname"), v4 = lights("rgb", "filename");
  CHECK(std::get<EnvironmentMapLight>(v3.lights.at(0).model).gamma == 1);
  CHECK_FALSE(std::get<EnvironmentMapLight>(v4.lights.at(0).model).gamma);
  const auto projector = [](const SceneDescription& d) {
    return std::get<ProjectorLight>(d.lights.at(1).model);
  };
  CHECK(projector(v3).fov == 45);
  CHECK(projector(v4).fov == 90);
  const auto image = [&](const SceneDescription& d) {
    const TextureId scaled = std::get<TextureId>(projector(d).irradiance);
    const auto& texture = std::get<ScaledTextureDescription>(d.textures.at(size_t(scaled)).model);
    return std::get<BitmapTexture>(d.textures.at(size_t(texture.inner)).model);
  };
  CHECK(image(v3).gamma == 1);
  CHECK(image(v3).filter == TextureFilter::bilinear);
  CHECK_FALSE(image(v4).gamma);
  CHECK(image(v4).filter == TextureFilter::nearest);
  // The first row is at the light's -y in v3, at its +y in v4.
  CHECK(v3.lights[1].to_world[1][1] == -1);
  CHECK(v4.lights[1].to_world[1][1] == 1);
  const auto plain = only_light<ProjectorLight>(
      world("LightSource \"projection\" \"rgb I\" [1 2 3] \"rgb scale\" [2 2 2]", true));
  CHECK(plain.irradiance == ColorInput(Spectrum(2, 4, 6)));
  CHECK_FALSE(world("LightSource \"projection\"").scene.has_value());
}

TEST_CASE("pbrt-v3: goniometric images of 8 bits are taken as they are") {
  const TemporaryDirectory folder;
  write_display_image(folder.path("map.png"), 1, 1, 3, {128, 128, 128});
  Diagnostics diagnostics;
  const auto scene = build_scene(
      scene_of(read_pbrt_file(folder.write("scene.pbrt",
                                           "Film \"image\"\nWorldBegin\nLightSource "
                                           "\"goniometric\" \"string mapname\" \"map.png\"\n"
                                           "Shape \"sphere\"\nWorldEnd\n"))),
      {}, diagnostics);
  REQUIRE(scene);
  const Spectrum c = scene->lights.at(0)->sample_direct({0, 0, 3}, {}).value().weight;
  CHECK(double(c.g) * 9 == doctest::Approx(128.0 / 255));
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
