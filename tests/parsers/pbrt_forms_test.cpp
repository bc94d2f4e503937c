// What pbrt allows in its files and what it refuses, where that is more or less than one expects.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include "pbrt/writer.h"
#include "support/files.h"
#include "support/pbrt_file.h"

using namespace duet;
using namespace duet::test;

namespace {

/// One before what follows on the line, unless the header has it.
std::string camera_after(const std::string& header) {
  return header.find("Camera") == header.npos ? "Camera \"perspective\" " : "";
}

PbrtFile v4(const std::string& world, const std::string& header = "") {
  return read_pbrt_file_of(header + camera_after(header) + "Film \"rgb\"\nWorldBegin\n" + world +
                           "\n");
}
PbrtFile v3(const std::string& world, const std::string& header = "") {
  return read_pbrt_file_of(header + camera_after(header) + "Film \"image\"\nWorldBegin\n" + world +
                           "\nWorldEnd\n");
}

bool has(const PbrtFile& f, const std::string& message) {
  return f.messages.find(message) != f.messages.npos;
}

void check_refused(const PbrtFile& f, const std::string& message) {
  CHECK_FALSE(f.scene.has_value());
  CHECK_MESSAGE(has(f, "error: " + message), f.messages);
}

/// The scene of a file about which there is nothing to say.
SceneDescription silent(const PbrtFile& f) {
  CHECK_MESSAGE(f.messages.empty(), f.messages);
  return scene_of(f);
}

}  // namespace

TEST_CASE("pbrt-v4: objects may be used before they are defined") {
  const std::string object =
      "ObjectBegin \"a\"\nAttributeBegin\nActiveTransform EndTime\nTranslate 4 0 0\n"
      "ActiveTransform All\nShape \"disk\"\nAttributeEnd\nShape \"sphere\"\nObjectEnd\n";
  const std::string use = "AttributeBegin\nTranslate 1 2 3\nObjectInstance \"a\"\nAttributeEnd\n";
  const SceneDescription before = silent(v4(use + object)), after = silent(v4(object + use));
  REQUIRE(before.shapes.size() == 2);
  for (size_t i = 0; i < 2; ++i) {
    CHECK(before.shapes[i].to_world == after.shapes.at(i).to_world);
    CHECK(before.shapes[i].motion == after.shapes.at(i).motion);
    CHECK(before.shapes[i].geometry == after.shapes.at(i).geometry);
  }
  check_refused(v4(use + "ObjectBegin \"b\"\nShape \"sphere\"\nObjectEnd\n"),
                "there is no object \"a\" (did you mean \"b\"?)");
  CHECK(has(v4(use), "scene.pbrt:5:1: error: there is no object \"a\""));
  // v3 goes by the order.
  check_refused(v3(use + object), "there is no object \"a\"");
}

TEST_CASE("pbrt-v3: unoccluded, ao is pi; in v4 it is one") {
  const std::string world = "Shape \"sphere\"";
  const std::string even = "\"bool cossample\" false\n";
  const SceneDescription dark = silent(v3(world, "Integrator \"ao\"\n"));
  REQUIRE(dark.sensors.at(0).film.response.has_value());
  const auto& response = *dark.sensors[0].film.response;
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j)
      CHECK(response[i][j] == doctest::Approx(i == j ? 3.14159265358979 : 0));
  // Which directions are taken makes no difference to the mean.
  CHECK(silent(v3(world, "Integrator \"ao\" " + even)).sensors == dark.sensors);
  CHECK_FALSE(silent(v4(world, "Integrator \"ambientocclusion\" " + even))
                  .sensors.at(0)
                  .film.response.has_value());
  // It multiplies what the film does, and limits of samples are those of the product.
  const TemporaryDirectory folder;
  const std::string both = folder.write("scene.pbrt",
                                        "Integrator \"ao\"\nCamera \"perspective\" Film \"image\" "
                                        "\"float scale\" 2 \"float maxsampleluminance\" 3\n"
                                        "WorldBegin\nShape \"sphere\"\nWorldEnd\n");
  const FilmDescription film = silent(read_pbrt_file(both)).sensors.at(0).film;
  CHECK((*film.response)[0][0] == doctest::Approx(2 * 3.14159265358979));
  const FilmDescription path =
      silent(read_pbrt_file_of("Camera \"perspective\" Film \"image\" \"float "
                               "maxsampleluminance\" 3\nWorldBegin\nWorldEnd\n"))
          .sensors.at(0)
          .film;
  CHECK(film.sample_limit->sensor[1][1] ==
        doctest::Approx(path.sample_limit->sensor[1][1] * 3.14159265358979));
  // Another integrator has its own unit.
  pbrt::Options options;
  options.replaces_integrator = true;
  CHECK_FALSE(
      silent(
          read_pbrt_file(
              folder.write("plain.pbrt",
                           "Integrator \"ao\"\nCamera \"perspective\" Film \"image\"\nWorldBegin\n"
                           "Shape \"sphere\"\nWorldEnd\n"),
              options))
          .sensors.at(0)
          .film.response.has_value());
  // pbrt-v4 says it by the film's speed.
  const pbrt::PbrtText written = pbrt::write_pbrt(dark);
  CHECK(written.losses.empty());
  CHECK(written.text.find("\"float iso\" 314.159") != std::string::npos);
}

TEST_CASE("pbrt versions are found in what a file includes") {
  const TemporaryDirectory folder;
  const auto version_of = [&](const std::string& main) {
    Diagnostics diagnostics;
    const auto scene = pbrt::read_pbrt(folder.write("scene.pbrt", main), {}, diagnostics);
    std::string messages;
    for (const Diagnostic& d : diagnostics.all()) messages += d.to_string() + "\n";
    REQUIRE_MESSAGE(scene.has_value(), messages);
    return int(scene->version);
  };
  folder.write("v3.pbrt", "Shape \"sphere\"\nMaterial \"matte\"\n");
  folder.write("outer.pbrt", "Include \"v3.pbrt\"\nInclude \"missing_here.pbrt\"\n");
  folder.write("missing_here.pbrt", "");
  CHECK(version_of("WorldBegin\nInclude \"v3.pbrt\"\n") == 3);
  CHECK(version_of("WorldBegin\nInclude \"outer.pbrt\"\n") == 3);
  // The main file's own word counts before that of others.
  CHECK(version_of("WorldBegin\nInclude \"missing_here.pbrt\"\nMaterial \"diffuse\"\n") == 4);
  CHECK(version_of("WorldBegin\nInclude \"missing_here.pbrt\"\n") == 4);
  // No more than the head of an included file is looked at.
  std::string numbers = "Shape \"loopsubdiv\" \"integer indices\" [0 1 2] \"float none\" [";
  while (numbers.size() < (size_t(1) << 20)) numbers += "1 2 3 4 5 6 7 8 9 10\n";
  folder.write("large.pbrt", numbers + "]\n\"point P\" [0 0 0 1 0 0 0 1 0]\n");
  Diagnostics ignored;
  const std::string main = folder.write("scene.pbrt", "WorldBegin\nInclude \"large.pbrt\"\n");
  CHECK(int(pbrt::find_version(main, {})) == 4);
}

TEST_CASE("pbrt-v4: the window of a camera is sorted") {
  const auto fov = [](const std::string& window) {
    return silent(v4("", "Camera \"perspective\" \"float screenwindow\" " + window + "\n"))
        .sensors.at(0)
        .fov;
  };
  CHECK(fov("[1 -1 -1 1]") == fov("[-1 1 -1 1]"));
  CHECK(fov("[-1 1 1 -1]") == fov("[-1 1 -1 1]"));
  check_refused(v4("", "Camera \"perspective\" \"float screenwindow\" [1 1 -1 1]\n"),
                "the screen window is empty");
}

TEST_CASE("pbrt-v4: a lens is round whatever the shape of the pixels") {
  for (const double aspect : {1.0, 2.0, 0.5}) {
    const SceneDescription d =
        silent(v4("", fmt::format("Camera \"perspective\" \"float lensradius\" 0.1 \"float "
                                  "frameaspectratio\" {}\n",
                                  aspect)));
    const SensorDescription& camera = d.sensors.at(0);
    const double height = double(camera.film.width) / camera.film.height / aspect;
    CHECK(std::abs(camera.to_world[1][1]) == doctest::Approx(height));
    CHECK(camera.aperture_aspect == doctest::Approx(1 / height));
  }
}

TEST_CASE("pbrt-v4: options have no type, any case and dashes, and stand anywhere") {
  const auto scale = [](const std::string& option) {
    const SceneDescription d = silent(v4("Shape \"sphere\"", option + "\n"));
    return d.shapes.size();
  };
  for (const std::string option :
       {"Option \"seed\" 3", "Option \"Seed\" 3", "Option \"disable-texture-filtering\" true",
        "Option \"DisableTextureFiltering\" true", "Option \"bool disable_texture_filtering\" true",
        "Option \"displacement-edge-scale\" 2.5", "Option \"render-coord-sys\" \"world\"",
        "Option \"float displacementedgescale\" 2"}) {
    CAPTURE(option);
    CHECK(scale(option) == 1);
    CHECK(silent(v4(option + "\nShape \"sphere\"\n")).shapes.size() == 1);
  }
  CHECK(has(v4("", "Option \"force-diffuse\" true\n"),
            "1:8: warning: parameter \"forcediffuse\" is ignored"));
  CHECK(has(v4("", "Option \"wavefrnt\" true\n"),
            "1:8: warning: Option has no parameter \"wavefrnt\""));
  check_refused(v4("", "Option \"seed\" true\n"), "a value of \"seed\" cannot be \"true\"");
}

TEST_CASE("pbrt: parameters go on where an included file ends") {
  const TemporaryDirectory folder;
  folder.write("camera.pbrt", "LookAt 0 0 5 0 0 0 0 1 0\nCamera \"perspective\"\n");
  folder.write("sphere.pbrt", "Material \"diffuse\"\nShape \"sphere\" \"float radius\" [");
  const PbrtFile f = read_pbrt_file(
      folder.write("scene.pbrt",
                   "Include \"camera.pbrt\"\n\"float fov\" 20\nFilm \"rgb\"\nWorldBegin\n"
                   "Include \"sphere.pbrt\" 2 ]\nInclude \"sphere.pbrt\"\n3]\nShape \"disk\" "
                   "\"float radiu\" 2\n"));
  REQUIRE_MESSAGE(f.scene, f.messages);
  CHECK(f.scene->sensors.at(0).fov > 20);
  CHECK(f.scene->sensors.at(0).fov < 60);
  REQUIRE(f.scene->shapes.size() == 3);
  CHECK(f.scene->shapes[1].to_world[0][0] == 3);
  // Places are those of the file that has them.
  CHECK_MESSAGE(has(f, "scene.pbrt:8:14: warning: Shape \"disk\" has no parameter \"radiu\""),
                f.messages);
}

TEST_CASE("pbrt: a coordinate system that there is not changes nothing") {
  for (const PbrtFile& f : {v4("Translate 1 0 0\nCoordSysTransform \"no\"\nShape \"sphere\""),
                            v3("Translate 1 0 0\nCoordSysTransform \"no\"\nShape \"sphere\"")}) {
    REQUIRE_MESSAGE(f.scene, f.messages);
    CHECK_MESSAGE(has(f, "scene.pbrt:4:1: warning: there is no coordinate system \"no\""),
                  f.messages);
    CHECK(f.scene->shapes.at(0).to_world[0][3] == 1);
  }
}

TEST_CASE("pbrt: the world begins once, and ends in v3 only") {
  check_refused(v4("WorldBegin"), "the world has begun already");
  CHECK(has(v3("WorldBegin"), "3:1: warning: the world has begun already"));
  CHECK(
      has(v4("\nWorldEnd"), "4:1: error: WorldEnd is pbrt-v3's, and this file is read as pbrt-v4"));
  CHECK(silent(v3("")).shapes.empty());
}

TEST_CASE("pbrt-v4: textures of the other kind, and words that there are not") {
  check_refused(v4("Texture \"t\" \"color\" \"constant\""),
                "a texture is of \"spectrum\" or \"float\", not \"color\"");
  for (const std::string name : {"fbm", "wrinkled", "windy"}) {
    const std::string colours = "Texture \"t\" \"spectrum\" \"" + name + "\"",
                      numbers = "Texture \"t\" \"float\" \"" + name + "\"";
    check_refused(v4(colours), "Texture \"" + name + "\" makes numbers, not colours, in pbrt-v4");
    silent(v4(numbers)), silent(v3(numbers));
    // What v3 does with it v4 does with the number.
    const pbrt::PbrtText written = pbrt::write_pbrt(
        silent(v3(colours + "\nMaterial \"matte\" \"texture Kd\" \"t\"\nShape \"sphere\"")));
    CHECK(written.losses.empty());
    CHECK(written.text.find("\"float\" \"" + name + "\"") != std::string::npos);
    CHECK(silent(read_pbrt_file_of(written.text)).shapes.size() == 1);
  }
  check_refused(v4("Texture \"t\" \"float\" \"marble\""),
                "Texture \"marble\" makes colours, not numbers, in pbrt-v4");
  silent(v4("Texture \"t\" \"spectrum\" \"marble\""));
}

TEST_CASE("pbrt images: filters by their names, and octahedral wrapping") {
  const TemporaryDirectory folder;
  const auto image = [&](const std::string& more) {
    folder.write("image.png", "");
    return read_pbrt_file(folder.write("scene.pbrt",
                                       "Camera \"perspective\" Film \"rgb\"\nWorldBegin\nTexture "
                                       "\"t\" \"spectrum\" \"imagemap\" \"string filename\" "
                                       "\"image.png\"\n" +
                                           more + "\n"));
  };
  for (const std::string filter : {"point", "bilinear", "trilinear", "ewa", "EWA"})
    silent(image("\"string filter\" \"" + filter + "\""));
  const PbrtFile wrong = image("\"string filter\" \"ewaa\"");
  CHECK(wrong.scene.has_value());
  CHECK_MESSAGE(has(wrong, "4:1: warning: there is no filter \"ewaa\" (did you mean \"ewa\"?)"),
                wrong.messages);
  const PbrtFile sphere = image("\"string wrap\" \"octahedralsphere\"");
  REQUIRE_MESSAGE(sphere.scene, sphere.messages);
  CHECK(has(sphere, "4:1: warning: approximated: "));
  CHECK_FALSE(image("\"string wrap\" \"mirror\"").scene.has_value());
}

TEST_CASE("pbrt-v4: indices of refraction by rgb, and metals by one thing only") {
  const SceneDescription d =
      silent(v4("Material \"dielectric\" \"rgb eta\" [1.25 1.25 1.25]\nShape \"sphere\""));
  CHECK(d.materials.at(size_t(d.shapes.at(0).material)).model.get<DielectricMaterial>().eta ==
        FloatInput(1.25));
  CHECK(has(v4("Material \"dielectric\" \"rgb eta\" [1.2 1.3 1.4]"),
            "3:23: warning: approximated: a refractive index without dispersion"));
  check_refused(v4("Material \"conductor\" \"rgb reflectance\" [.5 .5 .5] \"rgb eta\" [1 1 1]"),
                "a metal has either \"reflectance\" or an index: \"eta\"");
  check_refused(v4("Material \"coatedconductor\" \"rgb conductor.k\" [2 2 2] "
                   "\"rgb reflectance\" [.5 .5 .5]"),
                "a metal has either \"reflectance\" or an index: \"conductor.k\"");
}
