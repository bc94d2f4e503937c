// What the surfaces of pbrt files look like: bumps, ribbons and faces of four corners.
#include <doctest/doctest.h>

#include <algorithm>

#include "mitsuba/writer.h"
#include "support/pbrt_file.h"
#include "support/transport_scene.h"

using namespace duet;

TEST_CASE("pbrt: disks without textures are no triangles, and bumps know their mesh") {
  const test::TemporaryDirectory folder;
  const auto read = [&](const std::string& text) {
    Diagnostics diagnostics;
    auto r = pbrt::read_pbrt(folder.write("scene.pbrt", text), {}, diagnostics);
    REQUIRE(r.has_value());
    return r->description;
  };
  const SceneDescription plain = read("Film \"rgb\"\nWorldBegin\nShape \"disk\"\n");
  CHECK(std::holds_alternative<DiskShape>(plain.shapes.at(0).geometry));

  const std::string triangle = "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]",
                    normals = " \"normal N\" [0 0 1 0 0 1 0 0 1]";
  for (const bool v3 : {false, true}) {
    const SceneDescription d =
        read(std::string(v3 ? "Film \"image\"\nWorldBegin\nMaterial \"matte\"\n"
                            : "Film \"rgb\"\nWorldBegin\n") +
             triangle + "\n" + triangle + normals + "\n" +
             "Shape \"sphere\" \"float phimax\" 90\n" + (v3 ? "WorldEnd\n" : ""));
    const auto tangents = [&](size_t i) {
      return std::get<MeshShape>(d.shapes.at(i).geometry).mesh->bump_tangents;
    };
    CHECK(tangents(0) == BumpTangents::derivatives);
    CHECK(tangents(1) == (v3 ? BumpTangents::unit_backwards : BumpTangents::across_normals));
    CHECK(tangents(2) == BumpTangents::derivatives);
  }
  // Mitsuba's bumps have no such tangents.
  const std::string bumps =
      "Film \"rgb\"\nWorldBegin\nTexture \"f\" \"float\" \"fbm\"\n"
      "Material \"diffuse\" \"texture displacement\" \"f\"\n";
  const auto is_named = [&](const std::string& world) {
    const auto losses = write_mitsuba_xml(read(bumps + world)).losses;
    return std::any_of(losses.begin(), losses.end(),
                       [](const std::string& loss) { return loss.starts_with("bumps on meshes"); });
  };
  CHECK(is_named(triangle + normals + "\n"));
  CHECK_FALSE(is_named(triangle + "\n"));
}

TEST_CASE("pbrt curves: opaque ribbons are lit where rays are clear of them") {
  const test::TemporaryDirectory folder;
  const auto centre = [&](const std::string& material, const char* method) {
    const test::PbrtFile f = test::read_pbrt_file(
        folder.write("scene.pbrt",
                     "LookAt 0 0 5 0 0 0 0 1 0\nCamera \"perspective\" \"float fov\" 1\n"
                     "Film \"rgb\" \"integer xresolution\" 1 \"integer yresolution\" 1\n"
                     "PixelFilter \"box\"\nWorldBegin\n"
                     "LightSource \"point\" \"point3 from\" [0 0 2]\n" +
                         material +
                         "Shape \"curve\" \"point3 P\" [-3 0 0 -1 0 0 1 0 0 3 0 0]"
                         " \"float width\" .4\n"));
    REQUIRE_MESSAGE(f.scene.has_value(), f.messages);
    return double(test::TransportScene(*f.scene).render(method, {}, 64, 1).image.data[0]);
  };
  const double kPiD = 3.14159265358979;
  for (const char* method : {"path", "volpath", "direct"}) {
    CAPTURE(method);
    // The light is 2 away, less the width.
    CHECK(centre("Material \"diffuse\" \"rgb reflectance\" [.5 .5 .5]\n", method) ==
          doctest::Approx(0.5 / kPiD / (1.6 * 1.6)).epsilon(0.01));
    // What lets light through is lit where it is.
    CHECK(centre("Material \"diffusetransmission\" \"rgb reflectance\" [.5 .5 .5]"
                 " \"rgb transmittance\" [.2 .2 .2]\n",
                 method) == doctest::Approx(0.5 / kPiD / 4).epsilon(0.01));
  }
}

TEST_CASE("pbrt plymesh: a face of four corners is a patch in v4 and two triangles in v3") {
  const test::TemporaryDirectory folder;
  // Not flat: the middle is at 1/4 on the patch, and at 0 on the triangles' common edge.
  folder.write("quad.ply",
               "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
               "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
               "end_header\n0 0 0\n1 0 1\n1 1 0\n0 1 0\n4 0 1 2 3\n");
  const auto mesh = [&](const std::string& head, const std::string& tail) {
    const test::PbrtFile f = test::read_pbrt_file(folder.write(
        "scene.pbrt",
        head + "\nWorldBegin\nShape \"plymesh\" \"string filename\" \"quad.ply\"\n" + tail));
    REQUIRE_MESSAGE(f.scene.has_value(), f.messages);
    return std::get<MeshShape>(f.scene->shapes.at(0).geometry).mesh;
  };
  CHECK(mesh("Film \"rgb\"", "")->triangles.size() > 2);
  const auto two = mesh("Film \"image\"", "WorldEnd\n");
  CHECK(two->triangles ==
        std::vector<std::array<uint32_t, 3>>{std::array<uint32_t, 3>{0, 1, 2}, {3, 0, 2}});
  CHECK(two->normals.empty());
}
