// Faults of pbrt files after which pbrt goes on, and so does Duet, with a warning.
#include <doctest/doctest.h>

#include <cmath>

#include "support/files.h"
#include "support/pbrt_file.h"

using namespace duet;
using namespace duet::test;

namespace {

PbrtFile faulty_v4(const std::string& world,
                   const std::string& header = "Camera \"perspective\" ") {
  return read_pbrt_file_of(header + "Film \"rgb\"\nWorldBegin\n" + world + "\n");
}
PbrtFile faulty_v3(const std::string& world,
                   const std::string& header = "Camera \"perspective\" ") {
  return read_pbrt_file_of(header + "Film \"image\"\nWorldBegin\n" + world + "\nWorldEnd\n");
}

/// The scene of a file about which this is said.
SceneDescription warned(const PbrtFile& f, const std::string& message) {
  CHECK_MESSAGE(f.messages.find("warning: " + message) != f.messages.npos, f.messages);
  return scene_of(f);
}

const TriangleMesh& only_mesh(const SceneDescription& d) {
  return *std::get<MeshShape>(d.shapes.at(0).geometry).mesh;
}

}  // namespace

TEST_CASE("pbrt: meshes go without normals and texture coordinates of the wrong number") {
  const std::string mesh = "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] ";
  for (const bool is_v3 : {false, true}) {
    const auto read = [&](const std::string& more) {
      return is_v3 ? faulty_v3(more) : faulty_v4(more);
    };
    CHECK(only_mesh(warned(read(mesh + "\"normal N\" [0 0 1]"),
                           "there are 1 \"N\", but 3 points: they are left out, as in pbrt"))
              .normals.empty());
    CHECK(only_mesh(
              warned(read(mesh + "\"point2 uv\" [0 0 1 1]"), "there are 2 \"uv\", but 3 points"))
              .uvs.empty());
    CHECK(only_mesh(warned(read(mesh + "\"integer indices\" [0 1 2 0]"),
                           "the number of indices, 4, is no multiple of 3: the last ones are"))
              .triangles.size() == 1);
  }
  // v3 takes the first ones of too many, v4 none.
  const std::string four = mesh + "\"point2 uv\" [0 0 2 0 0 2 9 9]";
  const SceneDescription first = scene_of(faulty_v3(four));
  REQUIRE(only_mesh(first).uvs.size() == 3);
  CHECK(only_mesh(first).uvs[1].x == 2);
  CHECK(only_mesh(warned(faulty_v4(four), "there are 4 \"uv\", but 3 points")).uvs.empty());
  // Three points need no indices, four of a patch neither.
  const PbrtFile alone = faulty_v4(mesh);
  CHECK_MESSAGE(alone.messages.empty(), alone.messages);
  CHECK(only_mesh(scene_of(alone)).triangles.at(0) == std::array<uint32_t, 3>{0, 1, 2});
  const PbrtFile patch = faulty_v4("Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0]");
  CHECK_MESSAGE(patch.messages.empty(), patch.messages);
  warned(faulty_v4(
             "Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0] \"normal N\" [0 0 1]"),
         "there are 1 \"N\", but 4 points");
}

TEST_CASE("pbrt: ends without beginnings do nothing") {
  for (const std::string end : {"AttributeEnd", "TransformEnd"})
    for (const bool is_v3 : {false, true}) {
      const std::string world = "Translate 1 0 0\n" + end + "\nShape \"sphere\"";
      const SceneDescription d = warned(is_v3 ? faulty_v3(world) : faulty_v4(world),
                                        end + " without its beginning; it is ignored, as in pbrt");
      CHECK(d.shapes.at(0).to_world[0][3] == 1);
    }
  // Beginnings without ends are errors of v4.
  warned(faulty_v3("AttributeBegin\nShape \"sphere\""), "AttributeBegin without AttributeEnd");
  CHECK_FALSE(faulty_v4("AttributeBegin\nShape \"sphere\"").scene.has_value());
  // To v4 attributes and transforms are the same blocks.
  const PbrtFile crossed = faulty_v4(
      "AttributeBegin\nTranslate 1 0 0\nTransformBegin\nTranslate 1 0 0\nAttributeEnd\n"
      "Shape \"sphere\"\nTransformEnd\nShape \"sphere\"");
  CHECK_MESSAGE(crossed.messages.empty(), crossed.messages);
  CHECK(scene_of(crossed).shapes.at(0).to_world[0][3] == 1);
  CHECK(scene_of(crossed).shapes.at(1).to_world[0][3] == 0);
}

TEST_CASE("pbrt: words that there are not change nothing") {
  const SceneDescription d = warned(
      faulty_v4(
          "ColorSpace \"rec2021\"\nMaterial \"diffuse\" \"rgb reflectance\" [.1 .2 .3]\nShape "
          "\"sphere\""),
      "there is no colour space \"rec2021\" (did you mean \"rec2020\"?); the one before holds");
  const auto& both = d.materials.at(size_t(d.shapes.at(0).material)).model.get<TwoSidedMaterial>();
  CHECK(d.materials.at(size_t(both.front)).model.get<DiffuseMaterial>().reflectance ==
        ColorInput(Spectrum(.1f, .2f, .3f)));
  const std::string checks = "Texture \"t\" \"spectrum\" \"checkerboard\" ";
  const auto placed = [](const SceneDescription& read) {
    return std::get<CheckerboardTexture>(read.textures.at(0).model).to_uv;
  };
  const std::string flat = checks + "\"string mapping\" \"flat\" \"float uscale\" 3";
  for (const PbrtFile& f : {faulty_v3(flat), faulty_v4(flat)})
    CHECK(placed(warned(f, "there is no mapping \"flat\"; the surface's coordinates")) ==
          placed(scene_of(faulty_v4(checks))));
}

TEST_CASE("pbrt: matrices are affine within the rounding of single precision") {
  const auto place = [](const std::string& last) {
    return faulty_v4("Transform [1 0 0 " + last +
                     " 0 1 0 0 0 0 1 0 4 0 0 1.0000001]\nShape \"sphere\"");
  };
  const PbrtFile rounded = place("1e-7");
  CHECK_MESSAGE(rounded.messages.empty(), rounded.messages);
  CHECK(scene_of(rounded).shapes.at(0).to_world ==
        scene_of(faulty_v4("Translate 4 0 0\nShape \"sphere\"")).shapes.at(0).to_world);
  CHECK_FALSE(place("1e-4").scene.has_value());
}

TEST_CASE("pbrt-v3: a window whose sides are exchanged turns the picture over") {
  const auto camera = [](const std::string& type, const std::string& window) {
    const PbrtFile f =
        faulty_v3("", "Camera \"" + type + "\" \"float screenwindow\" " + window + " ");
    CHECK_MESSAGE(f.messages.empty(), f.messages);
    return scene_of(f).sensors.at(0);
  };
  for (const std::string type : {"perspective", "orthographic"}) {
    CAPTURE(type);
    const SensorDescription plain = camera(type, "[-1 3 -2 1]"), left = camera(type, "[1 -3 -2 1]"),
                            down = camera(type, "[-1 3 2 -1]");
    CHECK(left.fov == plain.fov);
    CHECK(left.principal_point_offset_x == plain.principal_point_offset_x);
    CHECK(left.to_world == Matrix4::scale(-1, 1, 1) * plain.to_world);
    CHECK(down.to_world == Matrix4::scale(1, -1, 1) * plain.to_world);
    CHECK(down.principal_point_offset_y == plain.principal_point_offset_y);
  }
}

TEST_CASE("pbrt: of parameters without effect those are named that would change something") {
  const auto messages = [](const std::string& regularize) {
    return faulty_v4(
               "Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0] \"string "
               "emissionfilename\" \"sampled.exr\"\n",
               "Camera \"perspective\" Integrator \"path\" \"bool regularize\" " + regularize + " ")
        .messages;
  };
  CHECK(messages("false") == "");
  CHECK(messages("true").find("parameter \"regularize\" is ignored") != std::string::npos);
}
