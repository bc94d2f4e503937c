// How files and plugins refer to one another: includes, paths, ids, aliases.
#include <doctest/doctest.h>

#include "parsers/plugin_checks.h"

using namespace duet;
using namespace duet::test;

TEST_CASE("included files: found beside their includer, share parameters and ids") {
  MemoryFiles files;
  files.texts = {
      {"/scene/parts/a.xml",
       "<scene version='0.6.0'><default name='r' value='7'/><include filename='b.xml'/>"
       "<bsdf type='conductor' id='metal'/></scene>"},
      {"/scene/parts/b.xml",
       "<scene version='3.0.0'><shape type='sphere'><float name='radius' value='$r'/>"
       "<ref id='metal'/></shape></scene>"},
      {"/scene/mat.xml",
       "<bsdf version='3.0.0' type='diffuse'><float name='reflectance' value='$g'/></bsdf>"},
  };
  const ReadResult r = read_scene("3.0.0", R"(
    <default name="g" value="0.125"/>
    <include filename="parts/a.xml"/>
    <shape type="cube"><include filename="mat.xml"/></shape>)",
                                  files);
  REQUIRE_MESSAGE(r.scene, r.messages());
  const SceneDescription& d = r.description();
  CHECK(d.shapes.size() == 2);
  CHECK(d.shapes[0].to_world[0][0] == 7);
  // The metal is in a file of 0.6: copper.
  CHECK(d.materials[size_t(d.shapes[0].material)].model.get<ConductorMaterial>().eta !=
        ColorInput(Spectrum(0.0f)));
  CHECK(d.materials[size_t(d.shapes[1].material)].model.get<DiffuseMaterial>().reflectance ==
        ColorInput(Spectrum(0.125f)));
  CHECK(d.shapes[0].where.to_string() == "/scene/parts/b.xml:1:24");
}

TEST_CASE("included files: loops, depth and absence are errors") {
  MemoryFiles files;
  files.texts["/scene/loop.xml"] =
      "<scene version='3.0.0'>\n<include filename='../scene/loop.xml'/></scene>";
  CHECK(read_scene("3.0.0", "<include filename='loop.xml'/>", files)
            .has("/scene/loop.xml:2:10: error: /scene/loop.xml includes itself"));
  CHECK(read_scene("3.0.0", "<include filename='scene.xml'/>").has("includes itself"));
  for (int i = 0; i < 40; ++i)
    files.texts["/scene/d" + std::to_string(i) + ".xml"] =
        "<scene version='3.0.0'><include filename='d" + std::to_string(i + 1) + ".xml'/></scene>";
  CHECK(read_scene("3.0.0", "<include filename='d0.xml'/>", files).has("more than 16 deep"));
  CHECK(read_scene("3.0.0", "<include filename='none.xml'/>")
            .has("scene.xml:2:10: error: file \"none.xml\" not found (looked in /scene)"));
  files.texts["/scene/e14.xml"] = "<scene version='3.0.0'/>";
  // Fourteen files that each include the next one ten times over.
  for (int i = 0; i < 14; ++i) {
    std::string ten;
    for (int j = 0; j < 10; ++j) ten += "<include filename='e" + std::to_string(i + 1) + ".xml'/>";
    files.texts["/scene/e" + std::to_string(i) + ".xml"] =
        "<scene version='3.0.0'>" + ten + "</scene>";
  }
  CHECK(read_scene("3.0.0", "<include filename='e0.xml'/>", files).has("more than 10000 files"));
}

TEST_CASE("paths and backslashes") {
  MemoryFiles files;
  files.texts = {{"/common/meshes/a.obj", ""}, {"/scene/meshes/b.obj", ""}};
  const ReadResult r = read_scene("3.0.0", R"(<path value="../common"/>
    <shape type="obj"><string name="filename" value="meshes/a.obj"/></shape>
    <shape type="obj"><string name="filename" value="meshes\b.obj"/></shape>)",
                                  files);
  REQUIRE_MESSAGE(r.scene, r.messages());
  CHECK(std::get<MeshShape>(r.description().shapes[0].geometry).source->file ==
        "/common/meshes/a.obj");
  CHECK(std::get<MeshShape>(r.description().shapes[1].geometry).source->file ==
        "/scene/meshes/b.obj");
  CHECK(read_scene("3.0.0", "<path value='nowhere'/>")
            .has("scene.xml:2:7: error: file \"nowhere\" not found"));
}

TEST_CASE("shapes that name the same file share its mesh") {
  MemoryFiles files;
  files.texts["/scene/a.obj"] = "";
  const std::string shape = "<shape type='obj'><string name='filename' value='a.obj'/></shape>";
  const ReadResult r = read_scene("3.0.0",
                                  shape + shape +
                                      "<shape type='obj'><string name='filename' value='a.obj'/>"
                                      "<boolean name='face_normals' value='true'/></shape>",
                                  files);
  REQUIRE(r.scene);
  const auto mesh = [&](size_t i) {
    return std::get<MeshShape>(r.description().shapes[i].geometry).mesh;
  };
  CHECK(mesh(0) == mesh(1));
  CHECK(mesh(0) != mesh(2));
}

TEST_CASE("references go forwards and backwards, through names and aliases") {
  const ReadResult r = read_scene("3.0.0", R"(
    <shape type="sphere"><ref id="later"/></shape>
    <shape type="cube"><ref name="bsdf" id="other"/></shape>
    <alias id="later" as="other"/>
    <bsdf type="diffuse" id="later"><ref name="reflectance" id="checks"/></bsdf>
    <texture type="checkerboard" id="checks"/>)");
  REQUIRE_MESSAGE(r.scene, r.messages());
  const SceneDescription& d = r.description();
  CHECK(d.materials.size() == 1);
  CHECK(d.textures.size() == 1);
  CHECK(d.shapes[0].material == d.shapes[1].material);
  CHECK(d.materials[0].model.get<DiffuseMaterial>().reflectance == ColorInput(TextureId{0}));
}

TEST_CASE("plugins that contain themselves are errors") {
  const auto loops = [](const std::string& content) {
    const ReadResult r = read_scene("3.0.0", content);
    return !r.scene && r.has("contains itself");
  };
  CHECK(loops("<texture type='checkerboard' id='t'><ref name='color0' id='t'/></texture>"));
  CHECK(
      loops("<bsdf type='twosided' id='a'><ref id='b'/></bsdf><bsdf type='mask' id='b'><ref "
            "id='a'/></bsdf>"));
  CHECK(
      loops(
          "<shape type='shapegroup' id='g'><shape type='instance'><ref id='g'/></shape></shape>") ==
      false);
  CHECK(loops(
      "<emitter type='constant'><spectrum type='d65' name='radiance' id='s'><ref name='color' "
      "id='s'/></spectrum></emitter>"));
  CHECK(!read_text(
             "<scene version='3.0.0'><sensor type='perspective'/><integrator type='moment' id='m'>"
             "<ref id='m'/></integrator></scene>")
             .scene);
  CHECK(
      read_scene(
          "3.0.0",
          "<alias id='a' as='b'/><alias id='b' as='a'/><shape type='sphere'><ref id='a'/></shape>")
          .has("nothing has the id"));
}
