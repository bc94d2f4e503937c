// Written as a Mitsuba 3 file and read again, a scene stays what it is.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>

#include "mitsuba/unstretched.h"
#include "mitsuba/writer.h"
#include "support/files.h"
#include "support/memory_scene.h"
#include "support/source_path.h"

using namespace duet;
using namespace duet::test;

namespace {

std::string all_messages(const Diagnostics& diagnostics) {
  std::string all;
  // What filters of polarised light are told does not change what they are.
  for (const Diagnostic& d : diagnostics.all())
    if (const std::string s = d.to_string(); s.find("without polarisation") == s.npos)
      all += s + "\n";
  return all;
}

SceneDescription read_from_disk(const std::string& file, const std::string& messages = "") {
  Diagnostics diagnostics;
  const auto scene = read_mitsuba(file, {}, diagnostics);
  CHECK(all_messages(diagnostics) == messages);
  REQUIRE(scene);
  return scene->description;
}

/// Writes and reads; the losses must be those expected.
SceneDescription again(const SceneDescription& scene, const std::vector<std::string>& losses = {}) {
  const TemporaryDirectory folder;
  const MitsubaXml xml = write_mitsuba_xml(scene);
  CHECK(xml.losses == losses);
  return read_from_disk(folder.write("scene.xml", xml.text));
}

/// Part by part, so that a failure says where the scenes differ.
void check_equal(const SceneDescription& a, const SceneDescription& b) {
  CHECK(a.textures == b.textures);
  CHECK(a.materials == b.materials);
  CHECK(a.volumes == b.volumes);
  CHECK(a.phases == b.phases);
  CHECK(a.media == b.media);
  CHECK(a.shapes == b.shapes);
  CHECK(a.groups == b.groups);
  CHECK(a.lights == b.lights);
  CHECK(a.sensors == b.sensors);
  CHECK(a == b);
}

const std::filesystem::path kScenes = source_path("scenes");

const CheckerboardTexture& board(const SceneDescription& scene, size_t i = 0) {
  return std::get<CheckerboardTexture>(scene.textures.at(i).model);
}

}  // namespace

TEST_CASE("every scene of the project is read without a surprise and survives a round trip") {
  size_t count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kScenes)) {
    if (entry.path().extension() != ".xml") continue;
    const std::string file = entry.path().string(), text = read_file(file);
    // What has no sensor is a part of another file.
    if (text.find("<sensor") == std::string::npos) continue;
    CAPTURE(file);
    ++count;
    // Scenes of the gallery leave the method to Duet.
    const bool left_to_duet = text.find("<integrator") == std::string::npos;
    CHECK(left_to_duet == (entry.path().parent_path().filename().string().find("gallery-") == 0));
    const SceneDescription scene = read_from_disk(
        file, left_to_duet ? file +
                                 ":1:1: warning: the scene has no integrator: \"auto\" is used "
                                 "(Mitsuba 3 would use \"path\")\n"
                           : "");
    using Losses = std::vector<std::string>;
    Losses losses = left_to_duet ? Losses{"only Duet reads the integrator \"auto\""} : Losses{};
    SceneDescription kept = scene;
    if (entry.path().parent_path().filename() == "curves") {
      losses.push_back("spheres stay round in Mitsuba 3: an ellipsoid becomes one");
      for (ShapeDescription& s : kept.shapes)
        if (std::holds_alternative<SphereShape>(s.geometry))
          s.to_world = unstretched(s.to_world).value_or(s.to_world);
    }
    check_equal(kept, again(scene, losses));
  }
  CHECK(count >= 15);
}

TEST_CASE("maps that are the same everywhere survive a round trip") {
  const ReadResult r = read_scene("3.0.0", R"(<emitter type="constant"/>
    <shape type="sphere"><bsdf type="normalmap"><bsdf type="diffuse"/>
      <texture type="rawconstant" name="normalmap"><vector name="value" value="0.2, 0.3, 0.9"/>
      </texture></bsdf></shape>
    <shape type="sphere"><bsdf type="bumpmap"><bsdf type="diffuse"/>
      <texture type="uniform"><float name="value" value="0.25"/></texture></bsdf></shape>)");
  REQUIRE_MESSAGE(r.scene, r.messages());
  check_equal(r.description(), again(r.description()));
}

TEST_CASE("the file of 0.6 and that of 3 in two-versions describe the same scene") {
  const SceneDescription a = read_from_disk((kScenes / "two-versions/scene.xml").string()),
                         b = read_from_disk((kScenes / "two-versions/scene-0.6.xml").string());
  check_equal(a, b);
  CHECK(!a.shapes.empty());
}

TEST_CASE("checkerboards as numbers: Mitsuba 3 exchanges their values, 0.6 does not") {
  const std::string boards = R"(
    <texture type="checkerboard" id="board"><float name="color0" value="0.1"/>
      <float name="color1" value="0.9"/></texture>)";
  const std::string as_number =
      "<bsdf type='mask'><ref name='opacity' id='board'/><bsdf type='diffuse'/></bsdf>";
  const std::string as_color = "<bsdf type='diffuse'><ref name='reflectance' id='board'/></bsdf>";
  const ColorInput low = Spectrum(0.1f), high = Spectrum(0.9f);
  const auto read = [&](const char* version, const std::string& uses) {
    const ReadResult r =
        read_scene(version, boards + uses + "<emitter type='constant'/><shape type='cube'/>");
    REQUIRE_MESSAGE(r.scene, r.messages());
    return r.description();
  };
  for (const char* version : {"0.6.0", "3.0.0"}) {
    const SceneDescription unused = read(version, ""), color = read(version, as_color);
    for (const SceneDescription& scene : {unused, color}) {
      CHECK(!board(scene).swap_values);
      CHECK(board(scene).color0 == low);
      CHECK(again(scene) == scene);
    }
  }
  const SceneDescription old = read("0.6.0", as_number), current = read("3.0.0", as_number);
  CHECK(board(old).color0 == low);
  CHECK(board(current).color0 == high);
  for (const SceneDescription& scene : {old, current}) {
    CHECK(!board(scene).swap_values);
    CHECK(again(scene) == scene);
  }
  // Used both ways, Mitsuba 3's exchange cannot be undone in one texture.
  const SceneDescription both = read("3.0.0", as_number + as_color);
  CHECK(board(both).swap_values);
  CHECK(board(both).color0 == low);
  CHECK(again(both) == both);
  const SceneDescription lost = read("0.6.0", as_number + as_color);
  CHECK(!board(lost).swap_values);
  CHECK(
      board(again(lost, {"a checkerboard used as colour and as number has its numbers exchanged"}))
          .swap_values);
}

TEST_CASE("checkerboards in checkerboards are asked for what the outer one is asked for") {
  const auto read = [](const std::string& use) {
    const ReadResult r = read_scene(
        "3.0.0",
        "<texture type='checkerboard' id='outer'><texture name='color0' type='checkerboard'/>"
        "</texture>" +
            use + "<emitter type='constant'/>");
    REQUIRE_MESSAGE(r.scene, r.messages());
    return r.description();
  };
  const SceneDescription number =
      read("<bsdf type='mask'><ref name='opacity' id='outer'/><bsdf type='diffuse'/></bsdf>");
  REQUIRE(number.textures.size() == 2);
  CHECK(board(number, 0).color0 == ColorInput(Spectrum(0.2f)));
  CHECK(board(number, 1).color1 == ColorInput(TextureId{0}));
  CHECK(again(number) == number);
  const SceneDescription color =
      read("<bsdf type='diffuse'><ref name='reflectance' id='outer'/></bsdf>");
  CHECK(board(color, 0).color0 == ColorInput(Spectrum(0.4f)));
  CHECK(board(color, 1).color0 == ColorInput(TextureId{0}));
  CHECK(again(color) == color);
}

TEST_CASE("what Mitsuba 3 cannot say is said in a comment") {
  const ReadResult r = read_text(R"(<scene version="0.6.0">
    <integrator type="path"><boolean name="strictNormals" value="true"/>
      <string name="lightSelection" value="bvh"/></integrator>
    <sensor type="perspective"><film type="ldrfilm"/><sampler type="halton"/></sensor>
    <emitter type="constant"/></scene>)");
  REQUIRE_MESSAGE(r.scene, r.messages());
  const MitsubaXml xml = write_mitsuba_xml(r.description());
  CHECK(xml.losses.size() == 4);
  for (const std::string& loss : xml.losses)
    CHECK(xml.text.find("Not in Mitsuba 3: " + loss) != std::string::npos);
  const SceneDescription copy = again(r.description(), xml.losses);
  CHECK(!std::get<PathIntegratorDescription>(copy.integrator.method).strict_normals);
  CHECK(!(copy == r.description()));
}
