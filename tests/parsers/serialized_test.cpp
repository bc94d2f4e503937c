#include <doctest/doctest.h>

#include "mesh/formats.h"
#include "support/serialized.h"

using namespace duet;
using namespace duet::test;

namespace {

TriangleMesh mesh_of(const std::string& file, const MeshOptions& options = {}) {
  ByteReader in("test.serialized", bytes_of(file));
  return parse_serialized(in, options);
}

/// A triangle with everything that the flags ask for.
template <class Number>
SerializedMesh triangle(uint32_t flags, int version = 4, uint32_t third = 2) {
  SerializedMesh mesh;
  mesh.flags = flags;
  mesh.version = version;
  const auto add = [&](auto... v) { mesh.data += pack(Number(v)...); };
  add(0, 0, 0, 1, 0, 0, 0, 1, 0);
  if (flags & 1) add(0, 0, 2, 0, 0, 2, 0, 1, 0);
  if (flags & 2) add(.25, .5, .75, 1, 0, .125);
  if (flags & 8) add(1, 2, 3, 4, 5, 6, 7, 8, 9);
  mesh.data += pack(0u, 3 - third, third);
  return mesh;
}

}  // namespace

TEST_CASE("serialized: versions 3 and 4, single and double precision, all that a mesh may have") {
  const TriangleMesh all = mesh_of(serialized_file({serialize(triangle<float>(0x100b))}));
  CHECK(all.positions == std::vector<Point3f>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  CHECK(all.normals == std::vector<Normal3f>{{0, 0, 1}, {0, 0, 1}, {0, 1, 0}});
  CHECK(all.uvs == std::vector<Point2f>{{.25f, .5f}, {.75f, 1}, {0, .125f}});
  CHECK(all.triangles == std::vector<std::array<uint32_t, 3>>{{0, 1, 2}});
  REQUIRE(all.attributes.size() == 1);
  CHECK(all.attributes[0] == MeshAttribute{"vertex_color", 3, false, {1, 2, 3, 4, 5, 6, 7, 8, 9}});
  CHECK_FALSE(all.computed_normals);
  CHECK(mesh_of(serialized_file({serialize(triangle<double>(0x200b))})) == all);
  CHECK(mesh_of(serialized_file({serialize(triangle<float>(0x000b))})) == all);
  CHECK(mesh_of(serialized_file({serialize(triangle<float>(0x100b, 3))}, 3)) == all);
  CHECK(mesh_of(serialize(triangle<float>(0x100b))) == all);  // without a table
}

TEST_CASE("serialized: normals are computed, dropped, or as the file's own flag says") {
  const std::string plain = serialize(triangle<float>(0x1000));
  CHECK(mesh_of(plain).normals == std::vector<Normal3f>(3, {0, 0, 1}));
  MeshOptions options;
  options.face_normals = true;
  CHECK(mesh_of(serialize(triangle<float>(0x1001)), options).normals.empty());
  const std::string faceted = serialize(triangle<float>(0x1011));
  CHECK(mesh_of(faceted).normals.size() == 3);  // Mitsuba 3 ignores the flag
  MeshOptions old;
  old.dialect = MeshDialect::mitsuba0;
  CHECK(mesh_of(faceted, old).normals.empty());
  old.max_smooth_angle = 10;
  CHECK(mesh_of(serialize(triangle<float>(0x1001)), old).normals ==
        std::vector<Normal3f>(3, {0, 0, 1}));
}

TEST_CASE("serialized: the mesh is chosen by its index") {
  for (const int version : {3, 4}) {
    const std::string file = serialized_file({serialize(triangle<float>(0x1000, version)),
                                              serialize(triangle<float>(0x1000, version, 1)),
                                              serialize(triangle<double>(0x2002, version))},
                                             version);
    MeshOptions options;
    CHECK(mesh_of(file, options).triangles[0][2] == 2);
    options.shape_index = 1;
    CHECK(mesh_of(file, options).triangles[0][2] == 1);
    options.shape_index = 2;
    CHECK(mesh_of(file, options).uvs.size() == 3);
    for (const int missing : {3, -1}) {
      options.shape_index = missing;
      CHECK_THROWS_WITH_AS(mesh_of(file, options), doctest::Contains("there is no mesh"),
                           ReadError);
    }
  }
}

TEST_CASE("serialized: large meshes pass through in blocks") {
  SerializedMesh mesh;
  mesh.vertices = 200000;
  mesh.triangles = 199998;
  for (uint32_t i = 0; i < 200000; ++i) mesh.data += pack(float(i), float(i % 7), float(i % 3));
  for (uint32_t i = 0; i < 199998; ++i) mesh.data += pack(i, i + 1, i + 2);
  TemporaryDirectory directory;
  MeshOptions options;
  options.shape_index = 1;
  const std::string file = directory.write(
      "large.serialized", serialized_file({serialize(triangle<float>(0x1000)), serialize(mesh)}));
  const TriangleMesh result = read_serialized(file, options);
  CHECK(result.positions[199999] == Point3f{199999, 199999 % 7, 199999 % 3});
  CHECK(result.triangles[199997] == std::array<uint32_t, 3>{199997, 199998, 199999});
}
