// Meshes of pbrt files whose surface a texture moves.
#include <doctest/doctest.h>

#include "evaluate/convert/convert_scene.h"
#include "scene/build.h"
#include "scene/displacement.h"
#include "support/files.h"
#include "support/pbrt_file.h"

using namespace duet;

namespace {

/// The unit square facing +z, as a face of four corners, with or without texture coordinates.
std::string square(bool with_uv) {
  const std::string uv = with_uv ? "property float u\nproperty float v\n" : "";
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\n" +
      uv + "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  for (const char* p : {"0 0", "1 0", "1 1", "0 1"})
    text += std::string(p) + " 0" + (with_uv ? std::string(" ") + p : "") + "\n";
  return text + "4 0 1 2 3\n";
}

/// Rises from 0 at u = 0 to 0.5 at u = 1.
constexpr const char* kRamp =
    "Texture \"ramp\" \"float\" \"bilerp\" \"float v00\" 0 \"float v01\" 0 \"float v10\" 0.5 "
    "\"float v11\" 0.5\n";

class Square {
 public:
  explicit Square(bool with_uv = true) { folder_.write("square.ply", square(with_uv)); }
  const test::TemporaryDirectory& folder() const { return folder_; }
  test::PbrtFile read(const std::string& before, const std::string& parameters,
                      const std::string& head = "") const {
    return test::read_pbrt_file(folder_.write(
        "scene.pbrt", head + "Film \"rgb\"\nWorldBegin\n" + kRamp + before +
                          "\nShape \"plymesh\" \"string filename\" \"square.ply\" " + parameters));
  }

 private:
  test::TemporaryDirectory folder_;
};

std::shared_ptr<const TriangleMesh> built(SceneDescription d) {
  Diagnostics diagnostics;
  const auto scene = build_scene(std::move(d), {}, diagnostics);
  REQUIRE_MESSAGE(scene, diagnostics.all().front().to_string());
  return scene->shapes.at(0).mesh;
}

}  // namespace

TEST_CASE("pbrt: the length of a displaced mesh's edges has two names") {
  const Square square;
  for (const char* name : {"edgelength", "displacement.edgelength"}) {
    const SceneDescription d = test::scene_of(square.read(
        "", std::string("\"texture displacement\" \"ramp\" \"float ") + name + "\" 0.25"));
    CHECK(std::get<MeshShape>(d.shapes.at(0).geometry).edge_length == 0.25);
  }
}

TEST_CASE("pbrt: a displaced mesh lies where the texture puts it") {
  const Square square;
  // Edges are measured in the world, where the square is three times as large; its own unit counts
  // for the texture's numbers. The normal is that of the mesh's own space whatever mirrors it.
  for (const char* place : {"Scale 3 3 3", "Scale -3 3 3", "ReverseOrientation Scale 3 3 3"}) {
    CAPTURE(place);
    const bool mirrored = std::string(place).starts_with("Scale -"),
               reversed = std::string(place).starts_with("Reverse");
    SceneDescription d = test::scene_of(
        square.read(place, "\"texture displacement\" \"ramp\" \"float edgelength\" 0.6"));
    CHECK(std::get<MeshShape>(d.shapes.at(0).geometry).mesh->triangles.size() == 2);
    const bool flipped = d.shapes[0].flip_normals;
    CHECK(flipped == reversed);
    const auto mesh = built(std::move(d));
    CHECK(mesh->triangles.size() >= 2 * 6 * 6);
    for (size_t i = 0; i < mesh->positions.size(); ++i) {
      const Point3f p = mesh->positions[i];
      CHECK(double(p.z) == doctest::Approx(0.5 * std::abs(double(p.x))).epsilon(1e-5));
      const Vector3f n(mesh->normals[i]);
      CHECK(double(n.z) == doctest::Approx(1 / std::sqrt(1.25)).epsilon(1e-4));
      CHECK(double(n.x) ==
            doctest::Approx((mirrored ? 0.5 : -0.5) / std::sqrt(1.25)).epsilon(1e-4));
    }
    for (const auto& t : mesh->triangles)
      for (size_t i = 0; i < 3; ++i) {
        const Vector3f edge = mesh->positions[t[(i + 1) % 3]] - mesh->positions[t[i]];
        CHECK(std::sqrt(edge.x * edge.x + edge.y * edge.y) < 0.6f);
      }
  }
}

TEST_CASE("pbrt: Option \"displacementedgescale\" makes the edges of displaced meshes longer") {
  const Square square;
  const auto triangles = [&](const std::string& head) {
    return built(test::scene_of(square.read(
                     "", "\"texture displacement\" \"ramp\" \"float edgelength\" 0.1", head)))
        ->triangles.size();
  };
  CHECK(triangles("Option \"float displacementedgescale\" 20\n") == 2);
  CHECK(triangles("") > 200);
}

TEST_CASE("pbrt: what cannot be displaced is said with its place") {
  const auto says = [](const Square& square, const std::string& before,
                       const std::string& parameters, const std::string& message) {
    const test::PbrtFile file = square.read(before, parameters);
    CHECK_FALSE(file.scene);
    CHECK_MESSAGE(file.messages.find(message) != std::string::npos, file.messages);
  };
  const std::string ramp = "\"texture displacement\" \"ramp\"";
  says(Square(false), "", ramp, "scene.pbrt:5:48: error: the file has no texture coordinates");
  says(Square(), "AreaLightSource \"diffuse\" \"float power\" 10", ramp,
       "error: a light with \"power\" cannot be displaced");
  says(Square(), "", ramp + " \"float edgelength\" 0", "\"edgelength\" must be");
  says(Square(), "", "\"float displacement\" 1", "\"displacement\" must be");

  Square square;
  Diagnostics diagnostics;
  CHECK_FALSE(build_scene(test::scene_of(square.read("", ramp + " \"float edgelength\" 1e-30")), {},
                          diagnostics));
  CHECK(diagnostics.all().at(0).to_string().find(
            "scene.pbrt:5:1: error: with edges shorter than 1e-30") != std::string::npos);
}

TEST_CASE("pbrt: a displaced mesh is converted") {
  const Square square;
  const SceneDescription d = test::scene_of(
      square.read("Scale 3 3 3", "\"texture displacement\" \"ramp\" \"float edgelength\" 0.6"));
  const ConvertedScene pbrt = convert_scene(d, square.folder().path("again.pbrt"));
  CHECK(pbrt.losses.empty());
  square.folder().write("again.pbrt", pbrt.files.back().bytes);
  const auto again = test::scene_of(test::read_pbrt_file(square.folder().path("again.pbrt")));
  CHECK(*built(again) == *built(d));

  const ConvertedScene xml = convert_scene(d, square.folder().path("scene.xml"));
  for (const std::string& loss : xml.losses) CHECK(loss.find("displace") == std::string::npos);
  REQUIRE(xml.files.size() == 2);
  SceneDescription displaced = d;
  displace_meshes(displaced);
  const auto& mesh = *std::get<MeshShape>(displaced.shapes.at(0).geometry).mesh;
  CHECK(xml.files[0].bytes.find(std::to_string(mesh.positions.size())) != std::string::npos);
  CHECK(mesh.triangles == built(d)->triangles);
}
