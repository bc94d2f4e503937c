// How bright lights of pbrt are: by power, by illuminance, by alpha, and on which side.
#include <doctest/doctest.h>

#include "image/image_io.h"
#include "mitsuba/writer.h"
#include "scene/build.h"
#include "support/files.h"
#include "support/pbrt_file.h"
#include "support/source_path.h"

using namespace duet;

namespace {

constexpr double kPiD = 3.14159265358979323846;

SceneDescription read(const test::TemporaryDirectory& folder, const std::string& world) {
  return test::scene_of(test::read_pbrt_file(folder.write(
      "scene.pbrt", "Camera \"perspective\"\nFilm \"rgb\"\nWorldBegin\n" + world + "\n")));
}

std::unique_ptr<Scene> built_scene(SceneDescription d) {
  Diagnostics diagnostics;
  auto scene = build_scene(std::move(d), {}, diagnostics);
  REQUIRE(scene);
  return scene;
}

/// Of the light of the only shape, at its first triangle or anywhere.
double radiance(const SceneDescription& d, uint32_t triangle = 0) {
  const auto scene = built_scene(d);
  Surface s{};
  s.shape = &scene->shapes.at(0);
  s.primitive = triangle;
  s.barycentric = {0.3f, 0.3f};
  s.uv = {0.25f, 0.5f};
  s.ng = s.shading.n = Normal3f(0, 0, 1);
  return double(
      static_cast<const SurfaceLight&>(*scene->lights.at(0)).emitted(s, Vector3f(0, 0, 1)).g);
}

const std::string kPower = "AreaLightSource \"diffuse\" \"float power\" 100\n";

}  // namespace

TEST_CASE("pbrt: every triangle of a mesh is a light of the power that is given") {
  const test::TemporaryDirectory folder;
  const std::string points = "\"point3 P\" [-9 -9 0 9 -9 0 9 9 0 -9 9 0]";
  const SceneDescription even =
      read(folder, kPower + "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] " + points);
  CHECK(radiance(even) == doctest::Approx(100 / (kPiD * 162)));
  CHECK(even.textures.empty());
  // One of half the area.
  const SceneDescription uneven =
      read(folder, kPower +
                       "Scale 2 2 2\nShape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] "
                       "\"point3 P\" [0 0 0 2 0 0 0 2 0 -1 0 0]");
  CHECK(radiance(uneven, 0) == doctest::Approx(100 / (kPiD * 8)));
  CHECK(radiance(uneven, 1) == doctest::Approx(100 / (kPiD * 4)));
  // A patch is one light, and quadrics take their area before they are scaled.
  CHECK(radiance(read(folder, kPower + "Shape \"bilinearmesh\" \"point3 P\" "
                                       "[-9 -9 0 9 -9 0 -9 9 0 9 9 0]")) ==
        doctest::Approx(100 / (kPiD * 324)));
  CHECK(radiance(read(folder, kPower + "Scale 3 3 3\nShape \"sphere\" \"float radius\" 2")) ==
        doctest::Approx(100 / (kPiD * 16 * kPiD)).epsilon(1e-3));
}

TEST_CASE("pbrt: a light shines by its alpha, but for alpha 0") {
  const test::TemporaryDirectory folder;
  const std::string light = "AreaLightSource \"diffuse\" \"rgb L\" [4 4 4]\n";
  const std::string quad =
      "Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point3 P\" [0 0 0 1 0 0 0 1 0] "
      "\"point2 uv\" [0 0 1 0 0 1] ";
  CHECK(radiance(read(folder, light + quad)) == doctest::Approx(4));
  CHECK(radiance(read(folder, light + quad + "\"float alpha\" .5")) == doctest::Approx(2));
  CHECK(radiance(read(folder, light + quad + "\"float alpha\" 0")) == doctest::Approx(4));
  CHECK(radiance(read(folder,
                      "Texture \"a\" \"float\" \"bilerp\" \"float v00\" 0 \"float v01\" 0 "
                      "\"float v10\" 1 \"float v11\" 1\n" +
                          light + quad + "\"texture alpha\" \"a\"")) == doctest::Approx(1));
}

TEST_CASE("pbrt: lights on meshes shine by the geometric normal") {
  const test::TemporaryDirectory folder;
  const auto side = [&](const std::string& shape, const std::string& light = "") {
    return read(folder, "AreaLightSource \"diffuse\" " + light + "\n" + shape)
        .shapes.at(0)
        .emission->side;
  };
  const std::string triangle = "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]",
                    normals = " \"normal N\" [0 0 1 0 1 1 0 0 1]";
  CHECK(side(triangle + normals) == EmittingSide::geometric);
  CHECK(side(triangle + normals, "\"bool twosided\" true") == EmittingSide::both);
  CHECK(side(triangle) == EmittingSide::shading);
  CHECK(side("Shape \"sphere\"") == EmittingSide::shading);
}

TEST_CASE("pbrt: a map of a given illuminance is twice as bright, as in pbrt") {
  const test::TemporaryDirectory folder;
  Image image(64, 64, {"R", "G", "B"});
  for (float& x : image.data) x = 2;
  write_exr(folder.path("even.exr"), image, {});
  const auto scene =
      built_scene(read(folder,
                       "LightSource \"infinite\" \"string filename\" \"even.exr\" \"float "
                       "illuminance\" 4\nShape \"disk\""));
  CHECK(double(scene->environment->emitted(Point3f(0), {0, 0, 1}).g) ==
        doctest::Approx(2 * 4 / kPiD).epsilon(2e-3));
}

TEST_CASE("pbrt: the XML of a medium that emits, or of a cloud, says what it lacks") {
  const test::TemporaryDirectory folder;
  const auto losses = [&](const std::string& medium) {
    std::string all;
    for (const std::string& loss :
         write_mitsuba_xml(read(folder, "MakeNamedMedium \"m\" " + medium +
                                            "\nMediumInterface \"m\" \"\"\nMaterial \"interface\"\n"
                                            "Shape \"sphere\""))
             .losses)
      all += loss + "\n";
    return all;
  };
  CHECK(losses("\"string type\" \"homogeneous\" \"rgb Le\" [1 1 1]").find("emission of a medium") !=
        std::string::npos);
  CHECK(losses("\"string type\" \"cloud\"").find("cloud of noise") != std::string::npos);
  CHECK(losses("\"string type\" \"homogeneous\"").find("medium") == std::string::npos);
}

TEST_CASE("pbrt: the factor of a NanoVDB file's light has two names") {
  const std::string file = test::source_path("scenes/pbrt-med-nanovdb/blob.nvdb");
  for (const char* name : {"Lescale", "LeScale"}) {
    const test::TemporaryDirectory folder;
    const SceneDescription d = read(
        folder, "MakeNamedMedium \"m\" \"string type\" \"nanovdb\" \"string filename\" \"" + file +
                    "\" \"string temperaturename\" \"density\" \"float " + name + "\" 2\n" +
                    "MediumInterface \"m\" \"\"\nMaterial \"interface\"\nShape \"sphere\"");
    CHECK(std::get<Spectrum>(d.media.at(0).emission.value().radiance) == Spectrum(2.0f));
  }
}
