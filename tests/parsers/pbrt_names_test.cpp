// Textures, materials and lights of pbrt files that are used before they are defined, or together.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include "image/image_io.h"
#include "scene/build.h"
#include "support/files.h"
#include "support/pbrt_file.h"

using namespace duet;
using namespace duet::test;

namespace {

SceneDescription v4_scene(const std::string& world) {
  return scene_of(read_pbrt_file_of("Film \"rgb\"\nWorldBegin\n" + world));
}
PbrtFile v3_scene(const std::string& world) {
  return read_pbrt_file_of("Film \"image\"\nWorldBegin\n" + world + "\nWorldEnd\n");
}

const MaterialModel& model_of(const SceneDescription& d, size_t shape) {
  return d.materials.at(size_t(d.shapes.at(shape).material)).model;
}

/// What a diffuse, two-sided material reflects.
ColorInput reflectance_of(const SceneDescription& d, size_t shape) {
  const auto& both = model_of(d, shape).get<TwoSidedMaterial>();
  return d.materials.at(size_t(both.front)).model.get<DiffuseMaterial>().reflectance;
}

/// The texture that is kept within [0, 1], since nothing was known of it when it was used.
TextureId clamped_from(const SceneDescription& d, const ColorInput& input) {
  TextureId id = std::get<TextureId>(input);
  for (int i = 0; i < 2; ++i)
    id = std::get<FunctionDescription>(d.textures.at(size_t(id)).model).inner;
  return id;
}

}  // namespace

TEST_CASE("pbrt-v4: textures are used before they are defined, constants and others") {
  const std::string shapes =
      "Material \"diffuse\" \"texture reflectance\" \"t\"\nShape \"sphere\"\n";
  const SceneDescription constant =
      v4_scene(shapes + "Texture \"t\" \"spectrum\" \"constant\" \"rgb value\" [.2 .4 .8]\n");
  const TextureId id = clamped_from(constant, reflectance_of(constant, 0));
  const auto& even = std::get<BilerpDescription>(constant.textures.at(size_t(id)).model);
  CHECK(even.v00 == Spectrum(0.2f, 0.4f, 0.8f));
  CHECK(even.v11 == even.v00);
  const SceneDescription board =
      v4_scene(shapes + "Texture \"t\" \"spectrum\" \"checkerboard\" \"rgb tex1\" [.1 .2 .3]\n");
  const TextureId other = clamped_from(board, reflectance_of(board, 0));
  CHECK(std::holds_alternative<CheckerboardTexture>(board.textures.at(size_t(other)).model));
  // Textures that are made of others come after them, and names belong to one kind.
  const PbrtFile nested = read_pbrt_file_of(
      "Film \"rgb\"\nWorldBegin\nTexture \"a\" \"float\" \"scale\" \"texture tex\" \"a\"\n");
  CHECK_MESSAGE(nested.messages.find("error: texture \"a\" is defined only after this one") !=
                    std::string::npos,
                nested.messages);
  // But images may come later, for pbrt loads them first.
  const std::string scaled =
      "Texture \"t\" \"spectrum\" \"scale\" \"texture tex\" \"later\" \"float scale\" .5\n";
  const TemporaryDirectory folder;
  Image pixels(1, 1, {"R", "G", "B"});
  pixels.data = {0.5f, 0.25f, 0.75f};
  write_exr(folder.path("image.exr"), pixels, {});
  const SceneDescription image = scene_of(
      read_pbrt_file(folder.write("scene.pbrt", "Film \"rgb\"\nWorldBegin\n" + shapes + scaled +
                                                    "Texture \"later\" \"spectrum\" \"imagemap\""
                                                    " \"string filename\" \"image.exr\"\n")));
  const TextureId halved = clamped_from(image, reflectance_of(image, 0));
  const auto& product = std::get<ScaledTextureDescription>(image.textures.at(size_t(halved)).model);
  CHECK(std::holds_alternative<BitmapTexture>(image.textures.at(size_t(product.inner)).model));
  const PbrtFile never = read_pbrt_file_of("Film \"rgb\"\nWorldBegin\n" + scaled);
  CHECK(never.messages.find("there is no texture \"later\" of colours") != std::string::npos);
  const PbrtFile kind = read_pbrt_file_of("Film \"rgb\"\nWorldBegin\n" + shapes +
                                          "Texture \"t\" \"float\" \"constant\"\n");
  CHECK(kind.messages.find("there is no texture \"t\" of colours") != std::string::npos);
  const PbrtFile v3 =
      v3_scene("Material \"matte\" \"texture Kd\" \"t\"\nTexture \"t\" \"color\" \"constant\"");
  CHECK(v3.messages.find("there is no texture \"t\" of colours") != std::string::npos);
}

TEST_CASE("pbrt-v4: materials with media are used before they are defined") {
  const std::string use =
      "MediumInterface \"fog\" \"fog\"\nNamedMaterial \"m\"\nShape \"sphere\"\n";
  const std::string fog = "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\"\n";
  const SceneDescription d =
      v4_scene(fog + use + "MakeNamedMaterial \"m\" \"string type\" \"subsurface\"\n");
  CHECK(d.shapes.at(0).interior.has_value());
  CHECK(d.shapes.at(0).exterior.has_value());
  CHECK(d.shapes.at(0).interior != d.shapes.at(0).exterior);
  CHECK(model_of(d, 0).is<DielectricMaterial>());
  // What shines needs a surface.
  const std::string lamp = "AreaLightSource \"diffuse\"\n" + use;
  const SceneDescription lit =
      v4_scene(fog + lamp + "MakeNamedMaterial \"m\" \"string type\" \"diffuse\"\n");
  CHECK(lit.shapes.at(0).emission.has_value());
  const SceneDescription dark =
      v4_scene(fog + lamp + "MakeNamedMaterial \"m\" \"string type\" \"interface\"\n");
  CHECK_FALSE(dark.shapes.at(0).emission.has_value());
}

TEST_CASE("pbrt: several environments add up") {
  const SceneDescription d = v4_scene(
      "LightSource \"infinite\" \"rgb L\" [1 2 3]\nLightSource \"point\"\n"
      "LightSource \"infinite\" \"rgb L\" [.5 0 1]\nLightSource \"point\"\nShape \"sphere\"\n");
  Diagnostics diagnostics;
  const auto scene = build_scene(d, {}, diagnostics);
  REQUIRE(scene);
  CHECK(scene->lights.size() == 3);
  REQUIRE(scene->environment);
  CHECK(scene->environment == scene->lights.at(scene->environment_index).get());
  CHECK(scene->environment->emitted({}, {0, 0, 1}) == Spectrum(1.5f, 2, 4));
}

TEST_CASE("pbrt-v3 takes no notice of parameters of another type, and of the first of two") {
  const PbrtFile r = v3_scene(
      "Material \"matte\" \"float Kd\" .1\nShape \"sphere\" \"float radius\" 2 \"float radius\" 3\n"
      "Material \"matte\" \"rgb Kd\" [-1 .5 1.5]\nShape \"sphere\"\n");
  REQUIRE_MESSAGE(r.scene.has_value(), r.messages);
  CHECK(std::get<Spectrum>(reflectance_of(*r.scene, 0)) == Spectrum(0.5f));
  CHECK(std::get<Spectrum>(reflectance_of(*r.scene, 1)) == Spectrum(0, 0.5f, 1.5f));
  CHECK(r.scene->shapes.at(0).to_world[0][0] == 3);
  CHECK(r.messages.find("must be of type") != std::string::npos);
  CHECK(r.messages.find("given twice: the last one counts") != std::string::npos);
}

TEST_CASE("pbrt-v4 takes the last of two parameters of a type, and numbers in single precision") {
  const PbrtFile r = read_pbrt_file_of(
      "Film \"rgb\"\nWorldBegin\nMaterial \"diffuse\" \"rgb reflectance\" [1.00000001 1 1]\n"
      "Shape \"sphere\" \"float radius\" 2 \"float radius\" 3\n");
  REQUIRE_MESSAGE(r.scene.has_value(), r.messages);
  CHECK(r.scene->shapes.at(0).to_world[0][0] == 3);
  CHECK(r.messages.find("given twice: the last one counts") != std::string::npos);
}

TEST_CASE("pbrt-v3 goes on without textures and materials that there are not") {
  const PbrtFile r = v3_scene(
      "Material \"matte\" \"rgb Kd\" [.1 .2 .3]\nNamedMaterial \"none of them\"\nShape \"sphere\"\n"
      "Material \"plastic\" \"texture Ks\" \"nothing\"\nShape \"sphere\"\n"
      "Material \"shinymetal\" \"rgb Kd\" [.4 .5 .6]\nShape \"sphere\"\n");
  REQUIRE_MESSAGE(r.scene.has_value(), r.messages);
  CHECK(std::get<Spectrum>(reflectance_of(*r.scene, 0)) == Spectrum(0.1f, 0.2f, 0.3f));
  CHECK(std::get<Spectrum>(model_of(*r.scene, 1).get<UberMaterial>().glossy_reflectance) ==
        Spectrum(0.25f));
  CHECK(std::get<Spectrum>(reflectance_of(*r.scene, 2)) == Spectrum(0.4f, 0.5f, 0.6f));
  CHECK(r.messages.find("there is no material \"none of them\" here") != std::string::npos);
}

TEST_CASE("pbrt-v3: directives at the wrong place and those of version 2 are left out") {
  const PbrtFile r = read_pbrt_file_of(
      "Renderer \"sampler\"\nVolumeIntegrator \"single\"\nMaterial \"matte\" \"rgb Kd\" [0 0 0]\n"
      "WorldBegin\nFilm \"image\" \"integer xresolution\" 7\nShape \"sphere\"\nWorldEnd\n");
  REQUIRE_MESSAGE(r.scene.has_value(), r.messages);
  CHECK(std::get<Spectrum>(reflectance_of(*r.scene, 0)) == Spectrum(0.5f));
  CHECK(r.scene->sensors.at(0).film.width == 1280);
  CHECK(r.messages.find("VolumeIntegrator \"single\" is pbrt-v2's") != std::string::npos);
  CHECK(r.messages.find("Renderer") == std::string::npos);
  CHECK(r.messages.find("Film stands before WorldBegin") != std::string::npos);
}

TEST_CASE("pbrt-v3 asks of an alpha only whether it is zero") {
  const PbrtFile r = v3_scene(
      "Texture \"t\" \"float\" \"checkerboard\" \"float tex1\" .25\n"
      "Shape \"sphere\" \"float alpha\" .25\nShape \"sphere\" \"float alpha\" 0\n"
      "Shape \"sphere\" \"texture alpha\" \"t\"\n");
  REQUIRE_MESSAGE(r.scene.has_value(), r.messages);
  CHECK_FALSE(model_of(*r.scene, 0).is<MaskMaterial>());
  CHECK(std::get<double>(model_of(*r.scene, 1).get<MaskMaterial>().opacity) == 0);
  const TextureId id = std::get<TextureId>(model_of(*r.scene, 2).get<MaskMaterial>().opacity);
  CHECK(std::get<FunctionDescription>(r.scene->textures.at(size_t(id)).model).function ==
        TextureFunction::positive);
}

TEST_CASE("pbrt-v4: a metal with a textured reflectance has the k of every place") {
  const SceneDescription d = v4_scene(
      "Texture \"t\" \"spectrum\" \"checkerboard\" \"rgb tex1\" [.1 .2 .3]\n"
      "Material \"conductor\" \"texture reflectance\" \"t\"\nShape \"sphere\"\n");
  const auto& both = model_of(d, 0).get<TwoSidedMaterial>();
  const auto& metal = d.materials.at(size_t(both.front)).model.get<ConductorMaterial>();
  CHECK(std::get<Spectrum>(metal.eta) == Spectrum(1));
  const TextureId id = std::get<TextureId>(metal.k);
  CHECK(std::get<FunctionDescription>(d.textures.at(size_t(id)).model).function ==
        TextureFunction::metal_k);
}

TEST_CASE("pbrt: materials mixed of themselves are read in linear time") {
  // Curves ask whether there is hair in the material: 2^60 ways lead to the one at the bottom.
  std::string world = "MakeNamedMaterial \"m0\" \"string type\" \"hair\"\n";
  for (int i = 0; i < 60; ++i)
    world += fmt::format(
        "MakeNamedMaterial \"m{}\" \"string type\" \"mix\" \"string materials\" [\"m{}\" \"m{}\"] "
        "\"float amount\" 0.5\n",
        i + 1, i, i);
  const SceneDescription d = v4_scene(
      world + "NamedMaterial \"m60\"\nShape \"curve\" \"point3 P\" [0 0 0 1 0 0 2 0 0 3 0 0]\n");
  CHECK(std::get<CurvesShape>(d.shapes.at(0).geometry).curves->profile == CurveProfile::tube);
}
