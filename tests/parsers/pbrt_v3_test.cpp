// What pbrt-v3 does otherwise than one expects, or than v4 does.
#include <doctest/doctest.h>

#include "support/files.h"
#include "support/pbrt_file.h"

using namespace duet;
using namespace duet::test;

namespace {

PbrtFile file_of_v3(const std::string& world) {
  return read_pbrt_file_of("Camera \"perspective\" Film \"image\"\nWorldBegin\n" + world +
                           "\nWorldEnd\n");
}

bool says(const PbrtFile& f, const std::string& message) {
  return f.messages.find(message) != f.messages.npos;
}

SceneDescription silent_v3(const std::string& world) {
  const PbrtFile f = file_of_v3(world);
  CHECK_MESSAGE(f.messages.empty(), f.messages);
  return scene_of(f);
}

/// What the diffuse material of a shape reflects.
Spectrum matte_of(const SceneDescription& d, size_t shape = 0) {
  const auto& both =
      d.materials.at(size_t(d.shapes.at(shape).material)).model.get<TwoSidedMaterial>();
  return std::get<Spectrum>(
      d.materials.at(size_t(both.front)).model.get<DiffuseMaterial>().reflectance);
}

}  // namespace

TEST_CASE("pbrt-v3: a shape may have parameters of its material") {
  const SceneDescription d = silent_v3(
      "Shape \"sphere\" \"float radius\" 2 \"rgb Kd\" [.1 .2 .3]\n"
      "Material \"matte\" \"rgb Kd\" [.4 .4 .4]\nShape \"sphere\" \"rgb Kd\" [.2 .2 .2]\n"
      "Shape \"sphere\"\n"
      "MakeNamedMaterial \"m\" \"string type\" \"plastic\" \"rgb Kd\" [.7 .7 .7] \"float "
      "roughness\" "
      ".2\nNamedMaterial \"m\"\nShape \"disk\" \"rgb Ks\" [0 0 .6]\nShape \"disk\"");
  CHECK(matte_of(d, 0) == Spectrum(.1f, .2f, .3f));
  CHECK(d.shapes[0].to_world[0][0] == 2);
  CHECK(matte_of(d, 1) == Spectrum(.2f));
  CHECK(matte_of(d, 2) == Spectrum(.4f));
  const auto plastic = [&](size_t shape) {
    return d.materials.at(size_t(d.shapes.at(shape).material)).model.get<UberMaterial>();
  };
  CHECK(plastic(3).glossy_reflectance == ColorInput(Spectrum(0, 0, .6f)));
  CHECK(plastic(3).diffuse_reflectance == ColorInput(Spectrum(.7f)));
  CHECK(plastic(4).glossy_reflectance == ColorInput(Spectrum(.25f)));
  // What the shape itself has is no business of the material, and neither has everything.
  const PbrtFile odd = file_of_v3(
      "Material \"hair\"\nShape \"trianglemesh\" \"float alpha\" 0 \"point P\" [0 0 0 1 0 0 0 1 0] "
      "\"rgb Kd\" [1 1 1]\nMaterial \"none\"\nShape \"disk\" \"float bumpmap\" 1");
  CHECK(says(odd, "4:68: warning: Shape \"trianglemesh\" has no parameter \"Kd\""));
  CHECK(says(odd, "warning: Shape \"disk\" has no parameter \"bumpmap\""));
  const SceneDescription masked = scene_of(odd);
  CHECK(masked.materials.at(size_t(masked.shapes.at(0).material)).model.is<MaskMaterial>());
  // A texture that was defined since the material was.
  const SceneDescription textured = silent_v3(
      "Material \"matte\"\nTexture \"t\" \"spectrum\" \"constant\" \"rgb value\" [.3 .2 .1]\n"
      "Shape \"disk\" \"texture Kd\" \"t\"");
  CHECK(matte_of(textured) == Spectrum(.3f, .2f, .1f));
}

TEST_CASE("pbrt-v4: materials have their parameters for themselves") {
  const PbrtFile f = read_pbrt_file_of(
      "Camera \"perspective\" Film \"rgb\"\nWorldBegin\nShape \"sphere\" \"rgb reflectance\" [1 1 "
      "1]\n");
  CHECK(says(f, "3:16: warning: Shape \"sphere\" has no parameter \"reflectance\""));
}

TEST_CASE("pbrt-v3: a number is no colour, and a colour no number") {
  const auto ignored = [](const std::string& world, const std::string& message) {
    const PbrtFile f = file_of_v3(world);
    CHECK_MESSAGE(says(f, "warning: " + message + "; it is ignored, as pbrt-v3 does"), f.messages);
    return scene_of(f);
  };
  const SceneDescription point =
      ignored("LightSource \"point\" \"rgb I\" [1 2 3] \"float scale\" 2",
              "parameter \"scale\" must be of type rgb, xyz, blackbody or spectrum, not float");
  CHECK(std::get<PointLight>(point.lights.at(0).model).intensity == Spectrum(1, 2, 3));
  const std::string use = "\nMaterial \"matte\" \"texture Kd\" \"t\"\nShape \"sphere\"";
  const SceneDescription color = ignored(
      "Texture \"t\" \"spectrum\" \"scale\" \"float tex1\" .5 \"rgb tex2\" [.1 .2 .3]" + use,
      "parameter \"tex1\" must be of type rgb, xyz, blackbody, spectrum or texture, not float");
  CHECK(matte_of(color) == Spectrum(.1f, .2f, .3f));
  ignored("Texture \"t\" \"float\" \"constant\" \"rgb value\" [.1 .2 .3]",
          "parameter \"value\" must be of type float or texture, not rgb");
  ignored(
      "MakeNamedMaterial \"a\" \"string type\" \"matte\"\nMaterial \"mix\" \"string "
      "namedmaterial1\" \"a\" \"string namedmaterial2\" \"a\" \"float amount\" .2",
      "parameter \"amount\" must be of type rgb, xyz, blackbody, spectrum or texture, not float");
}

TEST_CASE("pbrt-v3: of surplus values of what may be a texture the first counts") {
  const PbrtFile f = file_of_v3(
      "Material \"matte\" \"rgb Kd\" [.1 .2 .3 1 1 1] \"float sigma\" [0 20]\nShape \"sphere\"");
  CHECK(says(f, "3:18: warning: parameter \"Kd\" has surplus values: the first counts"));
  CHECK(says(f, "warning: parameter \"sigma\" has surplus values: the first counts"));
  CHECK(matte_of(scene_of(f)) == Spectrum(.1f, .2f, .3f));
  // Others are as if they were not there.
  const PbrtFile sphere = file_of_v3("Shape \"sphere\" \"float radius\" [2 3]");
  CHECK(says(sphere, "it is ignored, as pbrt-v3 does"));
  CHECK(scene_of(sphere).shapes.at(0).to_world[0][0] == 1);
}

TEST_CASE("pbrt-v3: surfaces that move emit no light") {
  const std::string world =
      "ActiveTransform EndTime\nTranslate 1 0 0\nActiveTransform All\n"
      "AreaLightSource \"diffuse\"\nShape \"sphere\"";
  const PbrtFile f = file_of_v3(world);
  CHECK(says(f, "scene.pbrt:7:1: warning: surfaces that move emit no light, as in pbrt-v3"));
  CHECK_FALSE(scene_of(f).shapes.at(0).emission);
  const PbrtFile v4 =
      read_pbrt_file_of("Camera \"perspective\" Film \"rgb\"\nWorldBegin\n" + world + "\n");
  CHECK(scene_of(v4).shapes.at(0).emission);
}

TEST_CASE("pbrt-v3: a surface without material may emit light, which v4's do not") {
  const std::string world =
      "AreaLightSource \"diffuse\"\nMaterial \"none\"\nShape \"sphere\"\nMaterial "
      "\"\"\nShape \"sphere\"";
  for (const ShapeDescription& s : silent_v3(world).shapes) CHECK(s.emission);
}

TEST_CASE("pbrt-v3's film has no pixelbounds") {
  const PbrtFile file = read_pbrt_file_of(
      "Film \"image\" \"integer pixelbounds\" [0 8 0 8]\nWorldBegin\nShape \"sphere\"\nWorldEnd\n");
  CHECK_FALSE(scene_of(file).sensors.at(0).film.crop);
  CHECK(file.messages.find("has no parameter \"pixelbounds\"") != std::string::npos);
}
