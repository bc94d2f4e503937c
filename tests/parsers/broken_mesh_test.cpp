#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "mesh/formats.h"
#include "support/serialized.h"

using namespace duet;
using namespace duet::test;

namespace {

/// What the error says, or "".
template <class Parse>
std::string message(Parse parse, const std::string& name, const std::string& contents) {
  try {
    ByteReader in(name, bytes_of(contents));
    parse(in);
  } catch (const ReadError& e) {
    return e.what();
  }
  return "";
}
std::string obj_message(const std::string& s) {
  return message([](ByteReader& in) { parse_obj(in, {}, false); }, "a.obj", s);
}
std::string ply_message(const std::string& s) {
  return message([](ByteReader& in) { parse_ply(in, {}); }, "a.ply", s);
}
std::string serialized_message(const std::string& s, int index = 0) {
  MeshOptions options;
  options.shape_index = index;
  return message([&](ByteReader& in) { parse_serialized(in, options); }, "a.serialized", s);
}

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

std::string ply_head(const std::string& format, const std::string& vertices,
                     const std::string& faces) {
  return "ply\nformat " + format + " 1.0\nelement vertex " + vertices +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}
std::string ascii_ply(const std::string& faces = "3 0 1 2\n",
                      const std::string& vertices = "0 0 0\n1 0 0\n0 1 0\n") {
  return ply_head("ascii", "3", "1") + vertices + faces;
}
std::string binary_ply() {
  return ply_head("binary_little_endian", "3", "1") +
         pack(0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, uint8_t(3), 0, 1, 2);
}

SerializedMesh serialized_triangle() {
  SerializedMesh mesh;
  mesh.data = pack(0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0, 1, 2);
  return mesh;
}

/// Cuts the file everywhere and changes bytes at random: an error or a mesh, nothing else. Returns
/// how many of the cut files were refused.
template <class Message>
size_t torture(const std::string& file, Message get_message) {
  size_t refused = 0;
  for (size_t length = 0; length < file.size(); ++length)
    refused += !get_message(file.substr(0, length)).empty();
  std::mt19937 generator(1);
  for (int i = 0; i < 3000; ++i) {
    std::string changed = file;
    for (int k = 0; k < 1 + i % 3; ++k) changed[generator() % file.size()] = char(generator());
    get_message(changed);
  }
  return refused;
}

}  // namespace

TEST_CASE("broken OBJ files are refused with the line") {
  const auto fails = [](const std::string& contents, const std::string& expected) {
    CHECK(obj_message(contents) == "a.obj:" + expected);
  };
  fails("", " has no faces; is it an OBJ file?");
  fails("<html>\n", " has no faces; is it an OBJ file?");
  fails(kSquare, " has no faces; is it an OBJ file?");
  fails(kSquare + "f 1 2\n", " has no faces; is it an OBJ file?");
  fails(kSquare + "f 1 2 9\nf 1 2 3\n", "5: position 9 does not exist; there are 4");
  fails(kSquare + "f 1 2 -5\n", "5: position -5 does not exist; there are 4 so far");
  fails(kSquare + "f 0 1 2\n", "5: position 0 does not exist; they count from 1");
  fails(kSquare + "f 1/1 2/1 3/1\n", "5: texture coordinate 1 does not exist; there are 0");
  fails(kSquare + "vn 0 0 1\n\nf 1//1 2//1 3//2\n", "7: normal 2 does not exist; there are 1");
  const std::string form = "\" is not a vertex of the form 1, 1/2, 1//3 or 1/2/3";
  fails(kSquare + "f 1 2 x\n", "5: \"x" + form);
  fails(kSquare + "f 1 2 3/x\n", "5: \"3/x" + form);
  fails(kSquare + "f 1/1/1/1 2 3\n", "5: \"1/1/1/1" + form);
  fails(kSquare + "f //1 2 3\n", "5: \"//1" + form);
  fails(kSquare + "f 1/-/1 2 3\n", "5: \"1/-/1" + form);
  fails(kSquare + "f 1.5 2 3\n", "5: \"1.5" + form);
  // Taken modulo 2³², this would be vertex 1.
  fails(kSquare + "f 4294967297 2 3\n", "5: \"4294967297" + form);
  fails(kSquare + "f 1 2 \\\n x\n", "5: \"x" + form);
  fails("v 0 x 0\n", "1: \"x\" is not a number");
  fails("v 0 0 1,5\n", "1: \"1,5\" is not a number");
  fails("v 0 0 0x10\n", "1: \"0x10\" is not a number");
  fails("v 0 0 1e\n", "1: \"1e\" is not a number");
  fails("v 0 0 .\n", "1: \".\" is not a number");
  fails("\nv nan 0 0\n", "2: \"nan\" is not a number");
  fails("v inf 0 0\n", "1: \"inf\" is not a number");
  fails("v 1e99 0 0\n", "1: the position is not finite");
  fails("vt 1e99 0\n", "1: the texture coordinates are not finite");
  fails("v 1 2\n", "1: 3 numbers are needed");
  fails("vt\t\n", "1: 1 number is needed");
  fails("vn 0 0 # 1\n", "1: 3 numbers are needed");
  fails("v 0 0 0\rv 0 0 0\rv 0 0\r", "3: 3 numbers are needed");
  fails(std::string("v 0 0 0\nv 0\0 0 0\n", 16), "2: not a text file");
  fails("v " + std::string(300000, '1') + " 0 0\n", "1: the line is too long");
}

TEST_CASE("broken PLY headers are refused with the line") {
  const auto fails = [](const std::string& contents, const std::string& expected) {
    CHECK(ply_message(contents) == "a.ply:" + expected);
  };
  fails("", " not a PLY file");
  fails("plyx\n", "1: not a PLY file");
  fails("ply\n", "1: the header does not end");
  fails("ply\nend_header\n", "2: the header states no format");
  fails("ply\nformat ascii 1.0\nformat ascii 1.0\n", "3: the format is given twice");
  fails("ply\nformat ascii 2.0\n", "2: the format is not one of PLY 1.0");
  fails("ply\nformat binary 1.0\n", "2: unknown format \"binary\"");
  fails("ply\nbanana\n", "2: \"banana\" is not understood");
  fails("ply\nproperty float x\n", "2: the property belongs to no element");
  fails("ply\nelement vertex\n", "2: an element needs a name and a number");
  fails("ply\nelement vertex -3\n", "2: \"-3\" is not a number of elements");
  fails("ply\nelement vertex 99999999999999999999\n",
        "2: \"99999999999999999999\" is not a number of elements");
  fails("ply\nelement vertex 1\nproperty floot x\n",
        "3: unknown type \"floot\" (did you mean \"float\"?)");
  fails("ply\nelement vertex 1\nproperty list float int x\n",
        "3: a list cannot have float elements");
  fails("ply\nelement vertex 1\nproperty float\n", "3: a property needs a type and a name");
  const std::string ascii = "ply\nformat ascii 1.0\n", xy = "property float x\nproperty float y\n",
                    vertex = "element vertex 0\n" + xy + "property float z\n";
  fails(ascii + "end_header\n", "3: there is no element \"vertex\"");
  fails(ascii + "element vertex 0\n" + xy + "end_header\n", "6: the vertices have no x, y and z");
  fails(ascii + vertex + "end_header\n",
        "7: there is no element \"face\"; is it a cloud of points?");
  fails(ascii + vertex + "element face 0\nend_header\n",
        "8: the faces have no list \"vertex_indices\" or \"vertex_index\"");
  fails(ascii + "element tristrips 1\nproperty list int int vertex_indices\nend_header\n0\n",
        "5: triangle strips are not supported; write the mesh with an element \"face\"");
  fails(ascii + vertex + "element vertex 0\nend_header\n", "8: there are two elements \"vertex\"");
  fails(ply_head("ascii", "1000000000000", "1"),
        "9: the file is too short for 1000000000000 elements \"vertex\"");
  fails(ply_head("binary_big_endian", "0", "18446744073709551615") + "abcdef",
        "9: the file is too short for 18446744073709551615 elements \"face\"");
}

TEST_CASE("broken PLY contents are refused") {
  REQUIRE(ply_message(ascii_ply()) == "");
  REQUIRE(ply_message(binary_ply()) == "");
  const auto fails = [](const std::string& contents, const std::string& expected) {
    CHECK(ply_message(contents) == "a.ply:" + expected);
  };
  fails(ascii_ply("3 0 1 7\n"), " triangle 0 uses vertex 7, but there are only 3 vertices");
  fails(ascii_ply("3 0 1 -1\n"), "13: the index of a vertex cannot be -1");
  fails(ascii_ply("3 0 1 1e30\n"), "13: the index of a vertex cannot be 1e+30");
  fails(ascii_ply("3 0 1 4294967296\n"),
        " triangle 0 uses vertex 4294967295, but there are only 3 vertices");
  fails(ascii_ply("3 0 1 0.5\n"), "13: the index of a vertex cannot be 0.5");
  fails(ascii_ply("2 0 1\n"), "13: face 0 has 2 corners");
  fails(ascii_ply("-3 0 1 2\n"), "13: the corners of a face cannot be -3");
  fails(ascii_ply("3 0 1 x\n"), "13: \"x\" is not a number (the index of a vertex)");
  fails(ascii_ply("3 0 1 2 5\n"), "13: there is more in the file than its header announces");
  fails(ascii_ply("3 0 1\n"), "13: the file ends before the index of a vertex");
  fails(ascii_ply("3 0 1 2\n", "0 0 0\n1 0 0\n0 nan 0\n"),
        " the position of vertex 2 is not finite");
  fails(ascii_ply("3 0 1 2\n", "0 0 0\n1 1e39 0\n0 0 0\n"),
        " the position of vertex 1 is not finite");
  fails(ascii_ply("3 0 1 2\n", "0 0 " + std::string(2000, '0') + "\n1 0 0\n0 0 0\n"),
        "10: the word is too long");
  fails(binary_ply() + "x", " there is more in the file than its header announces");
  fails(binary_ply().substr(0, binary_ply().size() - 1),
        " the file ends in the middle of the index of a vertex");
  const std::string attributes =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
      "property float z\nproperty float u\nproperty float v\n";
  const std::string faces = "element face 0\nproperty list uchar int vertex_indices\nend_header\n";
  fails(attributes + faces + "0 0 0 nan 0\n",
        " the texture coordinates of vertex 0 are not finite");
  fails(attributes + "property float a_x\n" + faces + "0 0 0 0 0 inf\n",
        " attribute vertex_a has numbers that are not finite");
  fails(attributes +
            "property float r\nproperty float g\nproperty float b\nproperty float color_x\n" +
            faces + "0 0 0 0 0 0 0 0 0\n",
        "15: there are two attributes \"vertex_color\"");
}

TEST_CASE("broken serialized files are refused") {
  REQUIRE(serialized_message(serialized_file({serialize(serialized_triangle())})) == "");
  const std::string one = serialize(serialized_triangle());
  const auto fails = [](const std::string& contents, const std::string& expected, int index = 0) {
    CHECK(serialized_message(contents, index) == "a.serialized: " + expected);
  };
  fails("", "the file ends in the middle of the header");
  fails("PK\x03\x04", "not a .serialized file");
  fails(pack(uint16_t(0x041c), uint16_t(2)) + "xyz",
        "is of version 2; only versions 3 and 4 can be read");
  fails(pack(uint16_t(0x041c), uint16_t(4)) + "not compressed",
        "the compressed data are damaged (incorrect header check)");
  fails(one.substr(0, 30), "the file ends in the middle of the mesh");
  SerializedMesh mesh = serialized_triangle();
  mesh.data.resize(mesh.data.size() - 1);
  fails(serialize(mesh), "the mesh ends before all its data");
  mesh = serialized_triangle();
  mesh.data.replace(mesh.data.size() - 4, 4, pack(3));
  fails(serialize(mesh), "triangle 0 uses vertex 3, but there are only 3 vertices");
  mesh = serialized_triangle();
  mesh.data.replace(12, 4, pack(NAN));
  fails(serialize(mesh), "the position of vertex 1 is not finite");
  mesh = serialized_triangle();
  mesh.flags = 0x2000;
  fails(serialize(mesh), "the mesh ends before all its data");
  mesh = serialized_triangle();
  mesh.vertices = uint64_t(1) << 62;
  fails(serialize(mesh),
        fmt::format("{} vertices and 1 triangles are more than the file can hold", mesh.vertices));
  mesh = serialized_triangle();
  mesh.triangles = 1000000000;
  fails(serialize(mesh), "3 vertices and 1000000000 triangles are more than the file can hold");
  mesh = serialized_triangle();
  mesh.name.assign(100000, 'x');
  fails(serialize(mesh), "the name of the mesh does not end");
  fails(one + pack(uint32_t(0xffffffff)),
        "the table of meshes is damaged (it has 4294967295 entries)", 1);
  fails(one + pack(uint64_t(0), uint64_t(1) << 60, 2u),
        fmt::format("the table of meshes is damaged (mesh at byte {})", uint64_t(1) << 60), 1);
  fails(one + pack(uint64_t(0), uint64_t(5), 2u), "mesh 1 does not begin where the table says", 1);
  std::string checksum = one;
  checksum.back() = char(checksum.back() + 1);
  fails(checksum, "the compressed data are damaged (incorrect data check)");
}

TEST_CASE("mesh files that are missing or no files are refused") {
  TemporaryDirectory directory;
  const std::string missing = directory.path("missing");
  for (const auto read : {read_obj, read_ply, read_serialized}) {
    CHECK_THROWS_WITH_AS(read(missing, {}),
                         (missing + ": cannot be opened: No such file or directory").c_str(),
                         ReadError);
    CHECK_THROWS_WITH_AS(read(directory.path("."), {}), doctest::Contains("is not a file"),
                         ReadError);
    CHECK_THROWS_WITH_AS(read("/dev/zero", {}), "/dev/zero: is not a file", ReadError);
  }
}

TEST_CASE("cut and changed mesh files give an error or a mesh") {
  const std::string obj =
      kSquare + "vt 0 .5\nvn 0 0 1\ng a\nusemtl b\nf 1/1/1 2/1/1 -2/-1/-1 4/1/1\n";
  CHECK(torture(obj, obj_message) > obj.size() - 30);
  CHECK(torture(ascii_ply(), ply_message) == ascii_ply().size() - 1);  // the last line end may go
  CHECK(torture(binary_ply(), ply_message) == binary_ply().size());
  const std::string serialized = serialize(serialized_triangle());
  CHECK(torture(serialized, [](const std::string& s) { return serialized_message(s); }) ==
        serialized.size());
}
