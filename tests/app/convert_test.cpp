// duet convert: what it writes, what it refuses, and whether images stay what they are.
#include <doctest/doctest.h>

#include "app/workplace.h"
#include "image/image_io.h"
#include "image/tile_test.h"

using namespace duet;
using namespace duet::test;

namespace {

constexpr int kImages = 8;

TileBatches render(const Workplace& place, const std::string& scene) {
  TileBatches batches;
  for (int seed = 1; seed <= kImages; ++seed) {
    const Outcome o =
        place.run({scene, "-o", "image.exr", "--spp", "32", "--seed", std::to_string(seed), "-q"});
    REQUIRE_MESSAGE(o.code == 0, o.err);
    batches.add(read_image(place.path("image.exr")).image);
  }
  return batches;
}

/// Converts to both formats; the images must have the same mean, tile by tile.
void check_images(const Workplace& place, const std::string& scene) {
  const TileBatches original = render(place, scene);
  CHECK(original.total().mean() > 0.05);
  for (const std::string out : {"out.xml", "out.pbrt"}) {
    CAPTURE(scene + " -> " + out);
    const Outcome o = place.run({"convert", scene, out, "--overwrite"});
    REQUIRE_MESSAGE(o.code == 0, o.err);
    const TileComparison c = compare_tiles(original, render(place, out));
    CHECK(c.equal());
    CHECK(c.visible_bias < 0.15);
    CHECK(c.ratio == doctest::Approx(1).epsilon(0.02));
  }
}

std::string pbrt_scene(const std::string& world, const std::string& integrator = "path") {
  return "Film \"rgb\" \"integer xresolution\" 32 \"integer yresolution\" 24 \"float iso\" 300\n"
         "Integrator \"" +
         integrator +
         "\" \"integer maxdepth\" 4\n"
         "LookAt 0 -6 3 0 0 0.5 0 0 1\nCamera \"perspective\" \"float fov\" 40\nWorldBegin\n"
         "Material \"diffuse\" LightSource \"infinite\" \"rgb L\" [0.2 0.25 0.3]\n"
         "AttributeBegin Translate 0 0 4 Rotate 180 1 0 0\n"
         "AreaLightSource \"diffuse\" \"rgb L\" [4 3 2] Shape \"disk\" AttributeEnd\n" +
         world;
}

const char* const kFloor =
    "Material \"diffuse\" \"rgb reflectance\" [0.6 0.5 0.4]\n"
    "Shape \"trianglemesh\" \"point3 P\" [-4 -4 0 4 -4 0 4 4 0 -4 4 0] "
    "\"integer indices\" [0 1 2 0 2 3]\n";

std::string xml_scene(const std::string& content) {
  return R"(<scene version="3.0.0"><integrator type="volpath">
    <integer name="max_depth" value="5"/></integrator>
  <sensor type="perspective"><float name="fov" value="40"/>
    <transform name="to_world"><lookat origin="0,-6,3" target="0,0,0.5" up="0,0,1"/></transform>
    <film type="hdrfilm"><integer name="width" value="32"/><integer name="height" value="24"/>
    </film></sensor>
  <emitter type="constant"><rgb name="radiance" value="0.2,0.25,0.3"/></emitter>
  <shape type="rectangle"><transform name="to_world"><scale value="4"/></transform>
    <bsdf type="twosided"><bsdf type="diffuse"><texture type="checkerboard" name="reflectance">
      <transform name="to_uv"><scale x="4" y="3"/></transform></texture></bsdf></bsdf></shape>
  <shape type="disk"><transform name="to_world"><rotate x="1" angle="180"/>
    <translate z="4"/></transform>
    <emitter type="area"><rgb name="radiance" value="9,7,5"/></emitter></shape>)" +
         content + "</scene>";
}

}  // namespace

TEST_SUITE("program") {
  TEST_CASE("convert: pbrt scenes look the same in both formats") {
    const Workplace place;
    place.write("surfaces.pbrt",
                pbrt_scene(std::string(kFloor) +
                           "AttributeBegin Translate -1 0 0.5 Material \"coateddiffuse\" \"float "
                           "roughness\" 0.1 Shape \"sphere\" \"float radius\" 0.5 AttributeEnd\n"
                           "AttributeBegin Translate 1 0 0 Material \"conductor\" \"float "
                           "roughness\" 0.2 Shape \"cylinder\" \"float radius\" 0.4 \"float zmin\" "
                           "0 AttributeEnd\n"
                           "ObjectBegin \"a\" Material \"diffuse\" \"rgb reflectance\" [0.9 0.1 "
                           "0.1] Shape \"sphere\" \"float radius\" 0.3 \"float zmax\" 0.1 "
                           "ObjectEnd\n"
                           "AttributeBegin Translate 0 -1 0.3 Scale 2 1 1 ObjectInstance \"a\" "
                           "AttributeEnd\n"
                           "LightSource \"point\" \"rgb I\" [3 3 3] \"point3 from\" [2 -2 2]\n"));
    check_images(place, "surfaces.pbrt");
    place.write(
        "fog.pbrt",
        pbrt_scene(std::string(kFloor) +
                       "AttributeBegin Translate 0 0 1 MakeNamedMedium \"fog\" \"string "
                       "type\" \"uniformgrid\" \"integer nx\" 2 \"integer ny\" 2 \"integer "
                       "nz\" 2 \"float density\" [1 2 3 4 1 2 3 4] \"rgb sigma_a\" [0.1 0.1 "
                       "0.1] \"rgb sigma_s\" [2 2 2] \"point3 p0\" [-1 -1 -1] "
                       "MediumInterface \"fog\" \"\" Material \"interface\" Shape "
                       "\"sphere\" AttributeEnd\n",
                   "volpath"));
    check_images(place, "fog.pbrt");
  }

  TEST_CASE("convert: Mitsuba scenes look the same in both formats") {
    const Workplace place;
    place.write("surfaces.xml", xml_scene(R"(
      <shape type="sphere"><point name="center" x="-1" y="0" z="0.5"/>
        <float name="radius" value="0.5"/><bsdf type="dielectric"/></shape>
      <shape type="cube"><transform name="to_world"><scale value="0.4"/><rotate z="1" angle="30"/>
        <translate x="1" z="0.4"/></transform><bsdf type="twosided"><bsdf type="diffuse">
        <rgb name="reflectance" value="0.8,0.2,0.1"/></bsdf></bsdf></shape>
      <shape type="shapegroup" id="pair"><shape type="sphere"><float name="radius" value="0.3"/>
        <bsdf type="conductor"><string name="material" value="Au"/></bsdf></shape></shape>
      <shape type="instance"><ref id="pair"/><transform name="to_world">
        <translate y="-1" z="0.3"/></transform></shape>
      <emitter type="point"><point name="position" x="2" y="-2" z="2"/>
        <rgb name="intensity" value="3"/></emitter>)"));
    check_images(place, "surfaces.xml");
    place.write("fog.xml", xml_scene(R"(
      <shape type="sphere"><point name="center" x="0" y="0" z="1"/><bsdf type="null"/>
        <medium type="homogeneous" name="interior"><rgb name="sigma_t" value="1,2,3"/>
          <rgb name="albedo" value="0.9,0.8,0.7"/><float name="scale" value="0.5"/>
          <phase type="hg"><float name="g" value="0.4"/></phase></medium></shape>)"));
    check_images(place, "fog.xml");
  }

  TEST_CASE("convert: what is lost is named, in a warning and in the file") {
    const Workplace place;
    place.write(
        "toplight.pbrt",
        pbrt_scene("AreaLightSource \"diffuse\" \"bool twosided\" true Shape \"sphere\"\n"));
    const std::string loss = "lost: light leaves a surface on one side only";
    const Outcome o = place.run({"convert", "toplight.pbrt", "out.xml"});
    CHECK(o.code == 0);
    CHECK(contains(o.err, "warning: toplight.pbrt: " + loss));
    CHECK(contains(read_file(place.path("out.xml")), loss.substr(6)));
    CHECK(place.run({"convert", "toplight.pbrt", "strict.xml", "--strict"}).code == 1);
    CHECK(!place.has("strict.xml"));
    // pbrt can say it.
    CHECK(place.run({"convert", "toplight.pbrt", "out.pbrt", "--strict"}).code == 0);
  }

  TEST_CASE("convert: files are referred to, and nothing is replaced by accident") {
    const Workplace place;
    std::filesystem::create_directory(place.path("sub"));
    const std::string ply = R"(ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
property float nx
property float ny
property float nz
property float u
property float v
element face 1
property list uchar int vertex_indices
end_header
0 0 0 0 0 1 0 0
1 0 0 0 0 1 1 0
0 1 0 0 0 1 0 1
3 0 1 2
)";
    place.write("mesh.ply", ply);
    place.write("in.pbrt", pbrt_scene("Shape \"plymesh\" \"string filename\" \"mesh.ply\"\n"));
    for (const std::string out : {"sub/a.xml", "sub/a.pbrt"}) {
      CHECK(place.run({"convert", "in.pbrt", out}).code == 0);
      CHECK(contains(read_file(place.path(out)), "\"../mesh.ply\""));
    }
    // The scenes alone, without meshes beside them.
    CHECK(std::distance(std::filesystem::directory_iterator(place.path("sub")), {}) == 2);
    place.write("own.pbrt", pbrt_scene(kFloor));
    CHECK(place.run({"convert", "own.pbrt", "own.xml"}).code == 0);
    REQUIRE(place.has("own-xml-mesh0.ply"));
    // The same again is the same; another mesh of that name is somebody's.
    CHECK(place.run({"convert", "own.pbrt", "own.xml"}).code == 0);
    place.write("own-xml-mesh0.ply", ply);
    const Outcome o = place.run({"convert", "own.pbrt", "own.xml"});
    CHECK(o.code == 1);
    CHECK(contains(o.err, "own-xml-mesh0.ply exists already"));
    CHECK(read_file(place.path("own-xml-mesh0.ply")) == ply);
    CHECK(place.run({"convert", "own.pbrt", "own.xml", "--overwrite"}).code == 0);
    CHECK(read_file(place.path("own-xml-mesh0.ply")) != ply);
  }

  TEST_CASE("convert: what cannot be done is said before anything is written") {
    const Workplace place;
    place.scene("in.xml");
    const auto refused = [&](const std::string& out, int code, const std::string& reason) {
      CAPTURE(out);
      const std::string before = read_file(place.path("in.xml"));
      const Outcome o = place.run({"convert", "in.xml", out});
      CHECK(o.code == code);
      CHECK_MESSAGE(contains(o.err, reason), o.err);
      CHECK(read_file(place.path("in.xml")) == before);
    };
    refused("in.xml", 2, "in.xml is the scene that is read");
    refused("./in.xml", 2, "is the scene that is read");
    refused("out.obj", 2, "must end in .xml or .pbrt");
    refused("none/out.xml", 2, "there is no folder");
    std::filesystem::create_directory(place.path("folder.xml"));
    refused("folder.xml", 2, "is not a regular file");
    place.write("other.xml", "by hand");
    refused("other.xml", 1, "other.xml exists already");
    CHECK(read_file(place.path("other.xml")) == "by hand");
    CHECK(place.run({"convert", "in.xml"}).code == 2);
    CHECK(place.run({"convert", "none.xml", "out.pbrt"}).code == 1);
    CHECK(!place.has("out.pbrt"));
  }
}
