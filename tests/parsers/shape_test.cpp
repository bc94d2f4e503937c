// What the parameters of textures and shapes become. Values that Mitsuba sets itself are those
// of 3.9.1.
#include <doctest/doctest.h>

#include "mitsuba/writer.h"
#include "parsers/plugin_checks.h"

using namespace duet;
using namespace duet::test;

TEST_CASE("texture: bitmap") {
  const std::string file = "<string name='filename' value='a.png'/>";
  BitmapTexture expected;
  expected.file = "/scene/a.png";
  CHECK(texture<BitmapTexture>("3.0.0", "bitmap", file) == expected);
  CHECK(texture<BitmapTexture>("0.6.0", "bitmap", file) == expected);  // EWA becomes bilinear
  expected.raw = true;
  CHECK(texture<BitmapTexture>("3.0.0", "bitmap", file + "<boolean name='raw' value='true'/>") ==
        expected);
  CHECK(texture<BitmapTexture>("0.6.0", "bitmap", file + "<float name='gamma' value='1.0'/>") ==
        expected);
  expected.raw = false;
  expected.gamma = 2.2;
  expected.filter = TextureFilter::nearest;
  expected.wrap_u = WrapMode::clamp;
  expected.wrap_v = WrapMode::zero;
  expected.channel = TextureChannel::alpha;
  expected.to_uv.m = {{{3, 0, 0.5}, {0, 4, 0}}};
  CHECK(texture<BitmapTexture>(
            "0.6.0", "bitmap",
            file + R"(<float name="gamma" value="2.2"/><string name="filterType" value="nearest"/>
    <string name="wrapMode" value="clamp"/><string name="wrapModeV" value="black"/>
    <string name="channel" value="a"/><float name="uvscale" value="3"/><float name="vscale" value="4"/>
    <float name="uoffset" value="0.5"/><boolean name="cache" value="false"/>)") == expected);
  const auto turned = texture<BitmapTexture>(
      "3.0.0", "bitmap",
      file +
          "<transform name='to_uv'><matrix value='1 2 0 3 4 5 0 6 0 0 1 0 0 0 0 1'/></transform>");
  CHECK(turned.to_uv.m == UvTransform{{{{1, 2, 3}, {4, 5, 6}}}}.m);
  CHECK(fails("3.0.0", "<texture type='bitmap'/>", "needs the parameter \"filename\""));
  CHECK(fails("3.0.0", "<texture type='bitmap'>\n<string name='filename' value='c.png'/></texture>",
              "scene.xml:3:25: error: file \"c.png\" not found"));
  CHECK(
      fails("3.0.0",
            "<texture type='bitmap'>" + file + "<string name='wrap_mode' value='tile'/></texture>",
            "it is one of repeat, mirror"));
}

TEST_CASE("texture: checkerboard, mesh attributes, scale") {
  const auto board = texture<CheckerboardTexture>(
      "0.6.0", "checkerboard",
      "<rgb name='color0' value='1 0 0'/><float name='uscale' value='2'/>");
  CHECK(board.color0 == ColorInput(Spectrum(1, 0, 0)));
  CHECK(board.color1 == ColorInput(Spectrum(0.2f)));
  CHECK(board.to_uv.m[0][0] == 2);
  CHECK(texture<MeshAttributeTexture>("3.0.0", "mesh_attribute",
                                      "<string name='name' value='vertex_color'/>") ==
        MeshAttributeTexture{"vertex_color", 1});
  CHECK(texture<MeshAttributeTexture>("0.6.0", "vertexcolors") ==
        MeshAttributeTexture{"vertex_color", 1});
  CHECK(fails("3.0.0",
              "<texture type='mesh_attribute'><string name='name' value='color'/></texture>",
              "begins with \"vertex_\" or \"face_\""));
  const auto scaled = texture<ScaledTextureDescription>(
      "0.6.0", "scale", kBoard + "<rgb name='scale' value='0.5 1 2'/>");
  CHECK(scaled.scale == Spectrum(0.5f, 1, 2));
  CHECK(fails("0.6.0", "<texture type='scale'><float name='scale' value='2'/></texture>",
              "needs a texture"));
}

TEST_CASE("texture: wireframe and curvature of 0.6") {
  WireframeTexture wireframe;
  CHECK(texture<WireframeTexture>("0.6.0", "wireframe") == wireframe);
  CHECK(texture<WireframeTexture>("0.6.0", "wireframe", "<float name='lineWidth' value='0'/>") ==
        wireframe);
  wireframe = {Spectrum(1, 0, 0), Spectrum(0, 0, 1), 0.25, 1};
  const std::string colours =
      "<rgb name='interiorColor' value='1 0 0'/><rgb name='edgeColor' value='0 0 1'/><float "
      "name='lineWidth' value='0.25'/>";
  const auto lines = texture<WireframeTexture>("0.6.0", "wireframe",
                                               colours + "<float name='stepWidth' value='7'/>");
  CHECK(lines == wireframe);
  CHECK(fails("0.6.0", "<texture type='wireframe'>\n<float name='lineWidth' value='-1'/></texture>",
              "scene.xml:3:25: error: the parameter \"lineWidth\" of <texture type=\"wireframe\"> "
              "must be at least 0"));
  CHECK(fails("0.6.0",
              "<texture type='wireframe'><texture name='edgeColor' type='wireframe'/></texture>",
              "cannot be a texture"));

  const std::string scale = "<float name='scale' value='2'/>";
  CHECK(texture<CurvatureTexture>("0.6.0", "curvature", scale) ==
        CurvatureTexture{CurvatureKind::gaussian, 2});
  CHECK(texture<CurvatureTexture>("0.6.0", "curvature",
                                  scale + "<string name='curvature' value='mean'/>") ==
        CurvatureTexture{CurvatureKind::mean, 2});
  CHECK(fails("0.6.0", "<texture type='curvature'/>", "needs the parameter \"scale\""));
  CHECK(fails(
      "0.6.0",
      "<texture type='curvature'>" + scale + "<string name='curvature' value='men'/></texture>",
      "(did you mean \"mean\"?); it is one of gaussian, mean"));
}

TEST_CASE("texture: wireframe and curvature are written, with the remark that Mitsuba 3 has none") {
  for (const char* content : {"wireframe'><float name='lineWidth' value='0.5'/><rgb "
                              "name='edgeColor' value='0.5 0.25 1'/>",
                              "wireframe'>",
                              "curvature'><float name='scale' value='2'/><string name='curvature' "
                              "value='mean'/>"}) {
    const SceneDescription d =
        good("0.6.0", std::string("<shape type='sphere'><bsdf type='diffuse'><texture "
                                  "name='reflectance' type='") +
                          content + "</texture></bsdf></shape>");
    const MitsubaXml xml = write_mitsuba_xml(d);
    REQUIRE(xml.losses.size() == 1);
    CHECK(xml.losses[0].find("does not exist in Mitsuba 3") != std::string::npos);
    const ReadResult again = read_text(xml.text);
    REQUIRE_MESSAGE(again.scene, again.messages());
    CHECK(again.description().textures == d.textures);
  }
}

TEST_CASE("shape: places and orientation") {
  const auto shape = [](const std::string& version, const std::string& type,
                        const std::string& content) {
    return good(version, "<shape type='" + type + "'>" + content + "</shape>").shapes.at(0);
  };
  const std::string stretched = "<transform name='to_world'><scale x='2'/></transform>";
  CHECK(shape("3.0.0", "disk", stretched).to_world == Matrix4::scale(2, 1, 1));
  // Mitsuba 3.9.1, p1 = (1, 2, 3), radius 2
  const Matrix4 cylinder =
      shape("3.0.0", "cylinder", "<point name='p1' value='1 2 3'/><float name='radius' value='2'/>")
          .to_world;
  const double expected[3][4] = {
      {1.92071, -0.158573, 1, 0}, {-0.158573, 1.68285, 2, 0}, {-0.534522, -1.06904, 3, 0}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j)
      CHECK(cylinder[i][j] == doctest::Approx(expected[i][j]).epsilon(1e-5));
  // p0 = (1, 1, 1), p1 = (1, 2, 1)
  const Matrix4 upright =
      shape("3.0.0", "cylinder", "<point name='p0' value='1 1 1'/><point name='p1' value='1 2 1'/>")
          .to_world;
  const double expected2[3][4] = {{1, 0, 0, 1}, {0, 0, 1, 1}, {0, -1, 0, 1}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j) CHECK(upright[i][j] == doctest::Approx(expected2[i][j]));
  CHECK(shape("3.0.0", "disk", "<boolean name='flip_normals' value='true'/>").flip_normals);
  CHECK(std::holds_alternative<RectangleShape>(shape("3.0.0", "rectangle", "").geometry));
  CHECK(std::holds_alternative<CubeShape>(shape("0.6.0", "cube", "").geometry));
  CHECK(fails("0.6.0", "<shape type='sphere'><float name='radius' value='-1'/></shape>",
              "must be positive, not -1"));
  CHECK(fails("3.0.0", "<shape type='sphere'><float name='radius' value='0'/></shape>",
              "must be other than 0"));
  CHECK(fails("0.6.0", "<shape type='cylinder'><float name='radius' value='-1'/></shape>",
              "must be positive, not -1"));
  CHECK(shape("3.0.0", "cylinder", "<float name='radius' value='-2'/>").to_world ==
        shape("3.0.0", "cylinder", "<float name='radius' value='2'/>").to_world *
            Matrix4::scale(-1, -1, 1));
  CHECK(fails("3.0.0", "<shape type='cylinder'><point name='p1' value='0 0 0'/></shape>",
              "the same point"));
}

TEST_CASE("shape: spheres stay round") {
  const auto read = [](const std::string& version, const std::string& transform) {
    return read_scene(version,
                      "<shape type='sphere'><point name='center' value='1 1 1'/><float "
                      "name='radius' value='2'/>\n<transform name='" +
                          std::string(version == "3.0.0" ? "to_world" : "toWorld") + "'>" +
                          transform + "</transform></shape>");
  };
  const auto place = [&](const std::string& version, const std::string& transform) {
    const ReadResult result = read(version, transform);
    CHECK(result.has("/scene/scene.xml:3:1: warning: spheres stay round in Mitsuba"));
    return result.description().shapes.at(0).to_world;
  };
  // Mitsuba 3.9.1: centre (2, 1, 1), radius 4.
  CHECK(place("3.0.0", "<scale x='2'/>") ==
        Matrix4{{{{4, 0, 0, 2}, {0, 4, 0, 1}, {0, 0, 4, 1}, {0, 0, 0, 1}}}});
  // A shear, mirrored. Mitsuba 3.9.1: centre (-2, 1, 1), radius 2.
  CHECK(place("3.0.0", "<matrix value='-1 -1 0 0 1 0 0 0 1'/>") ==
        Matrix4{{{{-2, 0, 0, -2}, {0, 2, 0, 1}, {0, 0, 2, 1}, {0, 0, 0, 1}}}});
  // Mitsuba 0.x scales the centre by the inverse of the radius as well.
  CHECK(place("0.6.0", "<scale x='2'/>") ==
        Matrix4{{{{4, 0, 0, 1}, {0, 4, 0, 0.5}, {0, 0, 4, 0.5}, {0, 0, 0, 1}}}});
  const ReadResult mirrored = read("0.6.0", "<scale x='-2' y='2' z='2'/>");
  CHECK(!mirrored.has("stay round"));
  CHECK(mirrored.description().shapes.at(0).flip_normals);
}

TEST_CASE("shape: meshes") {
  const auto mesh = [](const std::string& version, const std::string& type,
                       const std::string& content) {
    return *std::get<MeshShape>(good(version, "<shape type='" + type +
                                                  "'><string name='filename' value='a." + type +
                                                  "'/>" + content + "</shape>")
                                    .shapes.at(0)
                                    .geometry)
                .source;
  };
  CHECK(mesh("3.0.0", "obj", "").flip_tex_coords);
  CHECK(!mesh("3.0.0", "ply", "").flip_tex_coords);
  CHECK(mesh("0.6.0", "obj", "<float name='maxSmoothAngle' value='30'/>").max_smooth_angle == 30);
  CHECK(mesh("0.6.0", "serialized", "<integer name='shapeIndex' value='3'/>").shape_index == 3);
  CHECK(fails("0.6.0",
              "<shape type='obj'><string name='filename' value='a.obj'/><boolean "
              "name='faceNormals' value='true'/>"
              "<float name='maxSmoothAngle' value='3'/></shape>",
              "both \"face_normals\""));
  MemoryFiles files;
  files.texts["/scene/a.obj"] = "broken";
  CHECK(read_scene("3.0.0", "<shape type='obj'><string name='filename' value='a.obj'/></shape>",
                   files)
            .has("scene.xml:2:43: error: /scene/a.obj:7: not a face"));
}

TEST_CASE("shape: material by default, black under a light") {
  const SceneDescription d =
      good("3.0.0",
           "<shape type='sphere'/><shape type='cube'><emitter type='area'/></shape>"
           "<shape type='disk'/>");
  const auto reflectance = [&](size_t i) {
    return d.materials[size_t(d.shapes[i].material)].model.get<DiffuseMaterial>().reflectance;
  };
  CHECK(reflectance(0) == ColorInput(Spectrum(0.5f)));
  CHECK(reflectance(1) == ColorInput(Spectrum(0.0f)));
  CHECK(d.shapes[0].material == d.shapes[2].material);
  CHECK(d.shapes[1].emission->radiance == ColorInput(Spectrum(1.0f)));
  CHECK(!d.shapes[0].emission);
}

TEST_CASE("shape: lights on surfaces") {
  const SceneDescription d = good("3.0.0", R"(
    <emitter type="area" id="lamp"><texture name="radiance" type="checkerboard"/></emitter>
    <shape type="sphere"><ref id="lamp"/></shape>)");
  CHECK(d.shapes[0].emission->radiance == ColorInput(TextureId{0}));
  CHECK(d.lights.empty());
  CHECK(fails("3.0.0", "<shape type='sphere'><emitter type='point'/></shape>",
              "cannot be used in this place"));
  CHECK(fails("3.0.0", "<shape type='sphere'><emitter type='area'/><emitter type='area'/></shape>",
              "can have only one emitter"));
  CHECK(
      read_scene("3.0.0", "<emitter type='area'/>").has("belongs to no shape and gives no light"));
  CHECK(
      !read_scene("3.0.0", "<emitter type='area' id='a'/><shape type='cube'><ref id='a'/></shape>")
           .has("belongs to no shape"));
}

TEST_CASE("shape: groups and instances") {
  const SceneDescription d = good("0.6.0", R"(
    <shape type="instance"><ref id="g"/><transform name="toWorld"><translate x="1"/></transform></shape>
    <shape type="shapegroup" id="g"><shape type="sphere"/><shape type="cube"/></shape>
    <shape type="instance"><ref id="g"/></shape>)");
  CHECK(d.groups.size() == 1);
  CHECK(d.groups[0].shapes.size() == 2);
  CHECK(d.shapes.size() == 2);
  CHECK(d.shapes[0].geometry == d.shapes[1].geometry);
  CHECK(d.shapes[0].to_world[0][3] == 1);
  CHECK(fails("3.0.0", "<shape type='instance'/>", "needs a reference to a shape group"));
  CHECK(fails("3.0.0", "<shape type='instance'><shape type='sphere'/></shape>",
              "needs a shape group, not"));
  CHECK(
      fails("3.0.0",
            "<shape type='shapegroup'><shape type='sphere'><emitter type='area'/></shape></shape>",
            "cannot emit light"));
  CHECK(fails("3.0.0", "<shape type='shapegroup'><shape type='shapegroup'/></shape>",
              "in a shape group"));
}
