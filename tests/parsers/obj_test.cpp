#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>

#include "mesh/formats.h"
#include "support/files.h"

using namespace duet;
using namespace duet::test;

namespace {

const std::string kFourVertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

std::vector<ObjPart> parse(const std::string& text, const MeshOptions& options = {},
                           bool divide = false) {
  ByteReader in("test.obj", bytes_of(text));
  return parse_obj(in, options, divide).parts;
}
TriangleMesh obj(const std::string& text, const MeshOptions& options = {}) {
  return parse(text, options)[0].mesh;
}

using Triangles = std::vector<std::array<uint32_t, 3>>;
using Points = std::vector<Point3f>;
using Normals = std::vector<Normal3f>;

}  // namespace

TEST_CASE("OBJ: vertices are numbered in order of use and split where indices differ") {
  const TriangleMesh mesh = obj("v 9 9 9\n" + kFourVertices +
                                "vt 0 0\nvt .5 .25\nvn 0 0 2\nvn 0 1 0\n"
                                "f 3/1/1 4/1/1 5/2/1\nf 3/1/1 5/2/1 2/1/2\nf 3/1/1 4/1/1 2/2/2\n");
  CHECK(mesh.triangles == Triangles{{0, 1, 2}, {0, 2, 3}, {0, 1, 4}});
  CHECK(mesh.positions == Points{{1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}, {0, 0, 0}});
  CHECK(mesh.uvs == std::vector<Point2f>{{0, 0}, {0, 0}, {.5f, .25f}, {0, 0}, {.5f, .25f}});
  CHECK(mesh.normals == Normals{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 1, 0}, {0, 1, 0}});
  CHECK_FALSE(mesh.computed_normals);
}

TEST_CASE("OBJ: v is turned upside down on request, but not where a face has no coordinates") {
  MeshOptions flip;
  flip.flip_tex_coords = true;
  const std::string text = kFourVertices + "vt .25 .25\nf 1/1 2/1 3/1\nf 1 3 4\n";
  CHECK(obj(text).uvs[0] == Point2f{.25f, .25f});
  CHECK(obj(text, flip).uvs[0] == Point2f{.25f, .75f});
  CHECK(obj(text).uvs[3] == Point2f{0, 0});
  CHECK(obj(text, flip).uvs[3] == Point2f{0, 0});
  CHECK(obj(kFourVertices + "vt .5\nf 1/1 2/1 3/1\n").uvs[0] == Point2f{.5f, 0});
}

TEST_CASE("OBJ: polygons are fans around their first vertex") {
  CHECK(obj("v -1 .5 0\n" + kFourVertices + "f 2 3 4 5 1\n").triangles ==
        Triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}});
  // Faces of fewer than three corners have no surface, but their vertices have numbers.
  CHECK(obj(kFourVertices + "f 4 3\nf 1 2 3\n").triangles == Triangles{{2, 3, 1}});
}

TEST_CASE("OBJ: negative indices count back from where they stand, positive ones may look ahead") {
  const TriangleMesh plain = obj(kFourVertices + "vt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\n");
  CHECK(obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvn 0 0 1\n"
            "f -3/-1/-1 -2/-1/-1 -1/-1/-1\nv 0 1 0\n") == plain);
  CHECK(obj("f 1/1/1 2/1/1 3/1/1\n" + kFourVertices + "vt 0 0\nvn 0 0 1\n") == plain);
}

TEST_CASE("OBJ: line ends, continued lines, comments, a byte order mark, colours and weights") {
  const TriangleMesh plain = obj(kFourVertices + "f 1 2 3\n");
  CHECK(obj("\xef\xbb\xbfv 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nf 1 2 3") == plain);
  CHECK(obj("v 0 0 0\rv 1 0 0\rv 1 1 0\rf 1 2 3\r") == plain);
  CHECK(obj("v 0 \\\n 0 0\nv 1 0\\\r\n0\n v\t1 1 0 \nf 1 2 \\  \n3 # four\n") == plain);
  CHECK(obj(kFourVertices + "f 1 2 3 \\") == plain);
  CHECK(obj("# made by C:\\tools\\\nv +0 0.0 0e0 1 0 0\nv 1. .0 -0 0 1 0\nv 10e-1 1 0 0.5\n"
            "mtllib a\\b.mtl\nusemtl x\\\ns off\no thing\ng a b\nl 1 2\nf 1 2 3\n") == plain);
  CHECK(obj(kFourVertices + "f 1/ 2/ 3/\n") == plain);
  CHECK(obj(kFourVertices + "f 1/0/0 2// 3\n") == plain);
  CHECK(obj(kFourVertices + "f 1/0/0/ 2/// 3\n") == plain);
}

TEST_CASE("OBJ: missing normals are computed, zero ones stay for the renderer to replace") {
  const TriangleMesh computed = obj(kFourVertices + "vn 1 0 0\nf 1 2 3\n");
  CHECK(computed.computed_normals);
  CHECK(computed.normals == Normals(3, {0, 0, 1}));
  const TriangleMesh zero = obj(kFourVertices + "vn 0 0 0\nvn 0 0 2\nf 1//1 2//2 3//2\nf 1 3 4\n");
  CHECK_FALSE(zero.computed_normals);
  CHECK(zero.normals == Normals{{0, 0, 0}, {0, 0, 1}, {0, 0, 1}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
  const TriangleMesh extreme =
      obj(kFourVertices + "vn 3e30 0 4e30\nvn 3e-30 4e-30 0\nf 1//1 2//2 3//2\n");
  CHECK(extreme.normals[0].x == doctest::Approx(0.6));
  CHECK(extreme.normals[1].y == doctest::Approx(0.8));
  MeshOptions faceted;
  faceted.face_normals = true;
  CHECK(obj(kFourVertices + "f 1 2 3\n", faceted).normals.empty());
  // Mitsuba splits vertices by their normals' indices all the same.
  const TriangleMesh split =
      obj(kFourVertices + "vn 0 0 1\nvn 1 0 0\nf 1//1 2//1 3//1\nf 1//2 3//2 4//2\n", faceted);
  CHECK(split.normals.empty());
  CHECK(split.positions.size() == 6);
}

TEST_CASE("OBJ: creases, and Mitsuba 0.x's merging of equal vertices") {
  // A roof of two faces at a right angle; each vertex is written twice.
  const std::string roof =
      "v 0 0 0\nv 0 1 0\nv 1 1 1\nv 1 0 1\nv 1 0 1\nv 1 1 1\nv 2 1 0\nv 2 0 0\n"
      "f 4 3 2 1\nf 8 7 6 5\n";
  CHECK(obj(roof).positions.size() == 8);
  CHECK(obj(roof).normals[0] != obj(roof).normals[4]);
  MeshOptions old;
  old.dialect = MeshDialect::mitsuba0;
  const TriangleMesh merged = obj(roof, old);
  CHECK(merged.positions.size() == 6);
  CHECK(std::abs(merged.normals[0].x) < 0.3f);  // at the ridge
  CHECK(std::abs(merged.normals[2].x) > 0.7f);
  old.max_smooth_angle = 45;
  CHECK(obj(roof, old).positions.size() == 8);
  old.max_smooth_angle = 91;
  CHECK(obj(roof, old) == merged);
}

TEST_CASE("OBJ: parts by group and material, as Mitsuba 0.x divides a file") {
  const std::string text = kFourVertices +
                           "g first\nusemtl red \nf 1 2 3\nusemtl blue\nf 1 3 4\n"
                           "g second\nf 1 2 4\nusemtl unused\n";
  const std::vector<ObjPart> parts = parse(text, {}, true);
  REQUIRE(parts.size() == 3);
  CHECK(parts[0].material == "red");
  CHECK(parts[1].material == "blue");
  CHECK(parts[2].material == "blue");
  CHECK(parts[1].mesh.positions == Points{{0, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  CHECK(obj(text).triangles.size() == 3);
  CHECK(obj(text).positions.size() == 4);
}

TEST_CASE("OBJ: numbers are what strtof makes of them") {
  std::string text;
  const char* const numbers[] = {
      "0.1",      "-3.14159274",    "1e-7",          "123456789.123", "5e-39",
      "16777217", "0.000061035156", "0.30000001192", "-2.5E+3",       "+.5",
      "7.",       "1e-60",          "-1e-42"};
  for (const char* n : numbers) text += std::string("v ") + n + " 0 0\n";
  const TriangleMesh mesh = obj(text + "f 1 2 3 4 5 6 7 8 9 10 11 12 13\n");
  for (size_t i = 0; i < std::size(numbers); ++i)
    CHECK(mesh.positions[i].x == std::strtof(numbers[i], nullptr));
}

TEST_CASE("OBJ: reading a file gives what reading its text gives") {
  TemporaryDirectory directory;
  const std::string text = kFourVertices + "f 1 2 3\nusemtl a\nf 1 3 4\n";
  const std::string path = directory.write("square.obj", text);
  CHECK(read_obj(path, {}) == obj(text));
  CHECK(read_obj_parts(path, {}).parts.size() == 2);
  // Longer than a block of the reader.
  std::string strip;
  for (int i = 0; i < 40000; ++i) strip += fmt::format("v {} {} 0\n", i, i % 2);
  for (int i = 1; i + 2 <= 40000; ++i) strip += fmt::format("f {} {} {}\n", i, i + 1, i + 2);
  REQUIRE(strip.size() > 2 * ByteReader::kBlock);
  const TriangleMesh mesh = read_obj(directory.write("strip.obj", strip), {});
  CHECK(mesh.triangles.size() == 39998);
  CHECK(mesh == obj(strip));
}
