#include <doctest/doctest.h>

#include "mesh/formats.h"
#include "mesh/ply_values.h"
#include "support/files.h"

using namespace duet;
using namespace duet::test;

namespace {

TriangleMesh ply(const std::string& text, const MeshOptions& options = {}) {
  ByteReader in("test.ply", bytes_of(text));
  return parse_ply(in, options);
}

std::string properties(const std::vector<std::string>& names, const std::string& type = "float") {
  std::string s;
  for (const std::string& n : names) s += "property " + type + " " + n + "\n";
  return s;
}

/// A triangle in ascii with further properties of its vertices and its face, with values "1 2 …".
std::string triangle(const std::vector<std::string>& vertex,
                     const std::vector<std::string>& face = {}, const std::string& type = "float") {
  std::string s = "ply\nformat ascii 1.0\nelement vertex 3\n" + properties({"x", "y", "z"}) +
                  properties(vertex, type) + "element face 1\n" + properties(face, type) +
                  "property list uchar int vertex_indices\nend_header\n";
  const auto values = [](size_t n) {
    std::string v;
    for (size_t i = 0; i < n; ++i) v += " " + std::to_string(i + 1);
    return v;
  };
  for (const char* p : {"0 0 0", "1 0 0", "0 1 0"}) s += p + values(vertex.size()) + "\n";
  return s + values(face.size()) + " 3 0 1 2\n";
}

enum class Order { little, big };

/// Two triangles and an attribute in binary, every number of the given kinds, with much to skip.
template <class Number, class Count, class Index>
std::string binary(Order order, const char* number, const char* count, const char* index) {
  const bool swap = order == Order::big;
  std::string s = fmt::format(
      "ply\r\nformat binary_{}_endian 1.0\r\ncomment x\r\nobj_info y\r\nelement vertex 4\r\n"
      "property {} x\r\nproperty {} y\r\nproperty list {} {} skipped\r\nproperty {} z\r\n"
      "element material 2\r\nproperty list {} {} names\r\nelement nothing 99\r\n"
      "element face 2\r\nproperty {} weight_x\r\nproperty list {} {} vertex_index\r\n"
      "end_header\r\n",
      swap ? "big" : "little", number, number, count, index, number, count, index, number, count,
      index);
  const auto add = [&](auto... v) { s += swap ? pack_swapped(v...) : pack(v...); };
  const auto numbers = [&](auto... v) { add(Number(v)...); };
  const auto list = [&](auto... v) { add(Count(sizeof...(v)), Index(v)...); };
  numbers(0, 0), list(), numbers(0);
  numbers(1, 0), list(7), numbers(2);
  numbers(1, 1), list(7, 8), numbers(0);
  numbers(0, 1), list(1, 2, 3), numbers(0);
  list(1, 2), list(3);
  numbers(5), list(0, 1, 2);
  numbers(6), list(0, 2, 3);
  return s;
}

void check_square(const TriangleMesh& mesh) {
  CHECK(mesh.positions == std::vector<Point3f>{{0, 0, 0}, {1, 0, 2}, {1, 1, 0}, {0, 1, 0}});
  CHECK(mesh.triangles == std::vector<std::array<uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}});
  REQUIRE(mesh.attributes.size() == 1);
  CHECK(mesh.attributes[0] == MeshAttribute{"face_weight", 1, true, {5, 6}});
}

using Names = std::vector<std::string>;
Names names(const TriangleMesh& mesh) {
  Names result;
  for (const MeshAttribute& a : mesh.attributes)
    result.push_back(a.name + ":" + std::to_string(a.channels));
  return result;
}

}  // namespace

TEST_CASE("PLY: binary files of both byte orders, any types, lists and unknown elements") {
  check_square(ply(binary<float, uint8_t, int32_t>(Order::little, "float", "uchar", "int")));
  check_square(ply(binary<float, uint8_t, int32_t>(Order::big, "float32", "uint8", "int32")));
  check_square(ply(binary<double, uint32_t, uint16_t>(Order::little, "double", "uint", "ushort")));
  check_square(ply(binary<double, int16_t, int8_t>(Order::big, "float64", "short", "char")));
  check_square(ply(binary<float, int64_t, uint64_t>(Order::little, "float", "long", "ulong")));
  check_square(ply(binary<float, uint16_t, float>(Order::big, "float", "ushort", "float")));
}

TEST_CASE("PLY: half floats") {
  CHECK(half_to_float(0x3c00) == 1);
  CHECK(half_to_float(0xc000) == -2);
  CHECK(half_to_float(0x7bff) == 65504);
  CHECK(half_to_float(0x0001) == 0x1p-24f);
  CHECK(half_to_float(0x8000) == 0);
  CHECK(half_to_float(0xfc00) == -INFINITY);
  CHECK(std::isnan(half_to_float(0x7e00)));
  std::string s = "ply\nformat binary_little_endian 1.0\nelement vertex 3\n" +
                  properties({"x", "y", "z"}, "half") +
                  "element face 1\nproperty list uchar uchar vertex_indices\nend_header\n";
  for (int i = 0; i < 9; ++i) s += pack(uint16_t(i == 3 || i == 7 ? 0x3555 : 0));
  s += pack(uint8_t(3), uint8_t(0), uint8_t(1), uint8_t(2));
  CHECK(ply(s).positions[1].x == 0.333251953125f);
}

TEST_CASE("PLY: ascii numbers stand between any white space; polygons are fans") {
  const std::string text =
      "ply\nformat ascii 1.0\nelement face 2\nproperty list uchar int vertex_indices\n"
      "property float heat_x\nelement vertex 5\nproperty double x\nproperty double y\n"
      "property double z\nend_header\n5 0 1 2 3 4 7\n3 0 1 2\n8\n"
      "0 0 0 +1e0 0\t1e-999 1 1 0\r\n0 1 0\n\n -1 5e-1 0\n";
  const TriangleMesh mesh = ply(text);
  CHECK(mesh.triangles ==
        std::vector<std::array<uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 1, 2}});
  CHECK(mesh.positions[1] == Point3f{1, 0, 0});
  CHECK(mesh.positions[4] == Point3f{-1, 0.5f, 0});
  CHECK(mesh.attributes[0] == MeshAttribute{"face_heat", 1, true, {7, 7, 7, 8}});
}

TEST_CASE("PLY: normals and texture coordinates under all their names") {
  const TriangleMesh mesh = ply(triangle({"nz", "v", "nx", "u", "ny"}));
  CHECK(mesh.uvs == std::vector<Point2f>(3, {4, 2}));
  CHECK(mesh.normals[0].x == doctest::Approx(3 / std::sqrt(35.0)));
  CHECK(mesh.normals[0].z == doctest::Approx(1 / std::sqrt(35.0)));
  CHECK_FALSE(mesh.computed_normals);
  CHECK(ply(triangle({"s", "t"})).uvs[0] == Point2f{1, 2});
  CHECK(ply(triangle({"texture_u", "texture_v"})).uvs[0] == Point2f{1, 2});
  CHECK(ply(triangle({"s", "t", "u", "v"})).uvs[0] == Point2f{3, 4});
  CHECK(ply(triangle({"u"})).uvs.empty());
  MeshOptions options;
  options.flip_tex_coords = true;
  CHECK(ply(triangle({"u", "v"}), options).uvs[0] == Point2f{1, -1});
  options.face_normals = true;
  CHECK(ply(triangle({"nx", "ny", "nz"}), options).normals.empty());
  // Two of three components are no normals.
  CHECK(ply(triangle({"nx", "ny"})).normals == std::vector<Normal3f>(3, {0, 0, 1}));
}

TEST_CASE("PLY: attributes are grouped as Mitsuba 3.9.1 groups them") {
  CHECK(names(ply(triangle({"r", "g", "b"}))) == Names{"vertex_color:3"});
  CHECK(names(ply(triangle({"r", "g", "b", "a"}))) == Names{"vertex_color:3"});
  CHECK(names(ply(triangle({"blue", "red", "alpha", "green"}))) == Names{"vertex_color:3"});
  CHECK(ply(triangle({"blue", "red", "alpha", "green"})).attributes[0].data[0] == 2);
  CHECK(names(ply(triangle({"r", "g"}))) == Names{});
  CHECK(names(ply(triangle({"foo_x", "foo_y", "foo_z"}))) == Names{"vertex_foo:3"});
  CHECK(names(ply(triangle({"foo_0", "foo_1", "foo_2"}))) == Names{"vertex_foo:3"});
  CHECK(names(ply(triangle({"foo_1", "foo_2", "foo_3"}))) == Names{"vertex_foo:3"});
  CHECK(names(ply(triangle({"foo_r", "foo_g", "foo_b"}))) == Names{"vertex_foo_color:3"});
  CHECK(names(ply(triangle({"foo_x", "bar_0"}))) == Names{"vertex_foo:1", "vertex_bar:1"});
  CHECK(names(ply(triangle({"foo_x", "foo_y"}))) == Names{});
  CHECK(names(ply(triangle({"foo_x", "foo_y", "foo_z", "foo_w"}))) == Names{});
  CHECK(names(ply(triangle({"foo_x", "foo_z", "foo_y"}))) == Names{});
  CHECK(names(ply(triangle({"foo_y", "foo", "foo_xx", "_"}))) == Names{});
  CHECK(names(ply(triangle({"a_x", "b_x", "a_y"}))) == Names{"vertex_a:1", "vertex_b:1"});
  CHECK(names(ply(triangle({"a_x", "u", "a_y", "v", "a_z"}))) == Names{"vertex_a:3"});
  CHECK(names(ply(triangle({"a_x", "quality", "a_y", "a_z"}))) == Names{"vertex_a:1"});
  CHECK(names(ply(triangle({"r", "g", "b"}, {"r", "g", "b", "foo_x"}))) ==
        Names{"vertex_color:3", "face_color:3", "face_foo:1"});
}

TEST_CASE("PLY: integers in attributes, by the file's dialect") {
  // Values of Mitsuba 3.9.1.
  const auto value = [](const char* type, const MeshOptions& options = {}) {
    return ply(triangle({"red", "green", "blue"}, {}, type), options).attributes[0].data[1];
  };
  CHECK(value("uchar") == 2);
  CHECK(value("float") == 2);
  CHECK(value("long") == 2);
  CHECK(value("char") == doctest::Approx(0.00121889).epsilon(1e-5));
  CHECK(value("ushort") == doctest::Approx(2.36211e-06).epsilon(1e-5));
  CHECK(value("int") == doctest::Approx(7.20838e-11).epsilon(1e-5));
  MeshOptions old;
  old.dialect = MeshDialect::mitsuba0;
  CHECK(value("uchar", old) == doctest::Approx(2 / 255.0 / 12.92));
  CHECK(value("float", old) == doctest::Approx(std::pow(2.055 / 1.055, 2.4)));
  CHECK(names(ply(triangle({"diffuse_red", "diffuse_green", "diffuse_blue"}), old)) ==
        Names{"vertex_color:3"});
  CHECK(ply(triangle({"foo_x"}), old).attributes[0].data[0] == 1);
  old.srgb_colors = false;
  CHECK(value("uchar", old) == doctest::Approx(2 / 255.0));
  CHECK(value("float", old) == 2);
}

TEST_CASE("PLY: a mesh may be empty, and vertices may be unused") {
  const std::string head = "ply\nformat ascii 1.0\nelement vertex ";
  const std::string rest = properties({"x", "y", "z"}) +
                           "element face 0\nproperty list uchar int vertex_indices\nend_header\n";
  CHECK(ply(head + "0\n" + rest).positions.empty());
  const TriangleMesh points = ply(head + "1\n" + rest + "1 2 3");
  CHECK(points.triangles.empty());
  CHECK(points.normals == std::vector<Normal3f>{{0, 0, 0}});
}

TEST_CASE("PLY: a file is read in blocks") {
  std::string s = "ply\nformat binary_big_endian 1.0\nelement vertex 30000\n" +
                  properties({"x", "y", "z"}) +
                  "element face 29998\nproperty list uint uint vertex_indices\nend_header\n";
  for (uint32_t i = 0; i < 30000; ++i) s += pack_swapped(float(i), float(i % 2), 0.0f);
  for (uint32_t i = 0; i < 29998; ++i) s += pack_swapped(3u, i, i + 1, i + 2);
  REQUIRE(s.size() > 3 * ByteReader::kBlock);
  TemporaryDirectory directory;
  const TriangleMesh mesh = read_ply(directory.write("strip.ply", s), {});
  CHECK(mesh == ply(s));
  CHECK(mesh.positions[29999] == Point3f{29999, 1, 0});
  CHECK(mesh.triangles[29997] == std::array<uint32_t, 3>{29997, 29998, 29999});
}
