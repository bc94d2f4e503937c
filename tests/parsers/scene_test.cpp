// The language of scene files: versions, parameters, spellings, defaults.
#include <doctest/doctest.h>

#include "parsers/plugin_checks.h"

using namespace duet;
using namespace duet::test;

TEST_CASE("a scene of 0.6 and one of 3 that say the same are the same") {
  const char* old = R"(<?xml version='1.0' encoding='utf-8'?>
<scene version="0.6.0">
  <integrator type="path"><integer name="maxDepth" value="7"/><integer name="rrDepth" value="9"/>
    <boolean name="hideEmitters" value="true"/></integrator>
  <sensor type="thinlens">
    <float name="fov" value="40"/><string name="fovAxis" value="smaller"/>
    <float name="nearClip" value="0.5"/><float name="farClip" value="900"/>
    <float name="apertureRadius" value="0.1"/><float name="focusDistance" value="4"/>
    <transform name="toWorld"><lookAt origin="0, 1, 5" target="0 1 0" up="0,1,0"/></transform>
    <sampler type="stratified"><integer name="sampleCount" value="16"/></sampler>
    <film type="hdrfilm">
      <integer name="width" value="64"/><integer name="height" value="48"/>
      <integer name="cropOffsetX" value="8"/><integer name="cropOffsetY" value="4"/>
      <integer name="cropWidth" value="16"/><integer name="cropHeight" value="12"/>
      <string name="pixelFormat" value="luminanceAlpha"/><string name="componentFormat" value="float32"/>
      <boolean name="banner" value="false"/>
      <rfilter type="mitchell"/>
    </film>
  </sensor>
  <texture type="bitmap" id="wood"><string name="filename" value="wood.png"/>
    <string name="filterType" value="nearest"/><string name="wrapMode" value="mirror"/>
    <float name="gamma" value="1"/>
    <float name="uscale" value="2"/><float name="voffset" value="0.25"/></texture>
  <bsdf type="twosided" id="plastic">
    <bsdf type="roughplastic"><float name="intIOR" value="1.5"/><float name="extIOR" value="1"/>
      <ref name="diffuseReflectance" id="wood"/><rgb name="specularReflectance" value="0.5"/>
      <string name="distribution" value="ggx"/><boolean name="nonlinear" value="true"/></bsdf>
  </bsdf>
  <shape type="obj"><string name="filename" value="m.obj"/><boolean name="faceNormals" value="true"/>
    <ref id="plastic"/></shape>
  <shape type="sphere"><point name="center" x="1" y="2" z="3"/><float name="radius" value="2"/>
    <bsdf type="roughconductor"><string name="material" value="none"/>
      <float name="alphaU" value="0.1"/><float name="alphaV" value="0.3"/></bsdf></shape>
  <shape type="cylinder"><point name="p0" x="0" y="0" z="0"/><point name="p1" x="0" y="0" z="3"/>
    <boolean name="flipNormals" value="true"/>
    <emitter type="area"><spectrum name="radiance" value="3"/>
      <float name="samplingWeight" value="2"/></emitter></shape>
  <emitter type="point"><point name="position" x="0" y="4" z="0"/>
    <spectrum name="intensity" value="5 6 7"/></emitter>
  <emitter type="directional"><vector name="direction" x="1" y="-1" z="0"/></emitter>
</scene>)";
  const char* current = R"(<scene version='3.0.0'>
  <shape type="obj"><string name="filename" value="m.obj"/><boolean name="face_normals" value="true"/>
    <ref id="plastic"/></shape>
  <bsdf type="twosided" id="plastic">
    <bsdf type="roughplastic"><float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/>
      <texture name="diffuse_reflectance" type="bitmap"><string name="filename" value="wood.png"/>
        <string name="filter_type" value="nearest"/><string name="wrap_mode" value="mirror"/>
        <boolean name="raw" value="true"/>
        <transform name="to_uv"><scale x="2"/><translate y="0.25"/></transform></texture>
      <float name="specular_reflectance" value="0.5"/>
      <string name="distribution" value="ggx"/><boolean name="nonlinear" value="true"/></bsdf>
  </bsdf>
  <shape type="sphere"><transform name="to_world"><scale value="2"/><translate value="1,2,3"/></transform>
    <bsdf type="roughconductor">
      <float name="alpha_u" value="0.1"/><float name="alpha_v" value="0.3"/></bsdf></shape>
  <shape type="cylinder"><transform name="to_world"><scale z="3"/></transform>
    <boolean name="flip_normals" value="true"/>
    <emitter type="area"><rgb name="radiance" value="3 3 3"/>
      <float name="sampling_weight" value="2"/></emitter></shape>
  <emitter type="point"><transform name="to_world"><translate y="4"/></transform>
    <rgb name="intensity" value="5 6 7"/></emitter>
  <emitter type="directional"><vector name="direction" value="1 -1 0"/></emitter>
  <integrator type="path"><integer name="max_depth" value="7"/><integer name="rr_depth" value="9"/>
    <boolean name="hide_emitters" value="true"/></integrator>
  <sensor type="thinlens">
    <float name="fov" value="40"/><string name="fov_axis" value="smaller"/>
    <float name="near_clip" value="0.5"/><float name="far_clip" value="900"/>
    <float name="aperture_radius" value="0.1"/><float name="focus_distance" value="4"/>
    <transform name="to_world"><lookat origin="0, 1, 5" target="0, 1, 0" up="0, 1, 0"/></transform>
    <sampler type="stratified"><integer name="sample_count" value="16"/></sampler>
    <film type="hdrfilm">
      <integer name="width" value="64"/><integer name="height" value="48"/>
      <integer name="crop_offset_x" value="8"/><integer name="crop_offset_y" value="4"/>
      <integer name="crop_width" value="16"/><integer name="crop_height" value="12"/>
      <string name="pixel_format" value="luminance_alpha"/><string name="component_format" value="float32"/>
      <rfilter type="mitchell"><float name="B" value="0.33333333333333333"/></rfilter>
    </film>
  </sensor>
</scene>)";
  MemoryFiles files;
  files.texts = {{"/scene/wood.png", "x"}, {"/scene/m.obj", "x"}};
  const ReadResult a = read_text(old, files), b = read_text(current, files);
  REQUIRE_MESSAGE(a.scene, a.messages());
  REQUIRE_MESSAGE(b.scene, b.messages());
  CHECK(a.messages() == "");
  CHECK(b.messages() == "");
  CHECK(a.description().textures == b.description().textures);
  CHECK(a.description().materials == b.description().materials);
  CHECK(a.description().shapes == b.description().shapes);
  CHECK(a.description().lights == b.description().lights);
  CHECK(a.description().sensors == b.description().sensors);
  CHECK(a.description() == b.description());
  // And the comparison sees a difference.
  std::string other = old;
  other.replace(other.find("value=\"7\""), 9, "value=\"8\"");
  CHECK(!(read_text(other, files).description() == b.description()));
}

TEST_CASE("the version of a file decides what it means") {
  const auto mirror = [](const std::string& version) {
    return read_bsdf<ConductorMaterial>(version, "<bsdf type='conductor'/>").eta ==
           ColorInput(Spectrum(0.0f));
  };
  for (const char* v : {"2.0.0", "2.1.0", "3.0.0", "3.9.1", "3"}) CHECK(mirror(v));
  for (const char* v : {"0.4.0", "0.5.0", "0.6.0", "0.6"}) CHECK(!mirror(v));
  CHECK(read_text("<scene version='0.3.0'/>").has("are not understood"));
  CHECK(read_text("<scene/>").has("scene.xml:1:1: error: <scene> needs the attribute \"version\""));
  CHECK(read_text("<scene version='three'/>").has("is not a version"));
  CHECK(read_text("<scene version='1.2.3.4'/>").has("is not a version"));
}

TEST_CASE("names of both spellings are understood in files of both kinds") {
  const auto eta = [](const std::string& version, const std::string& name) {
    return std::get<double>(
        read_bsdf<DielectricMaterial>(version, "<bsdf type='dielectric'><float name='" + name +
                                                   "' value='1.5'/><float name='extIOR' "
                                                   "value='1'/></bsdf>")
            .eta);
  };
  for (const char* version : {"0.5.0", "3.0.0"}) {
    CHECK(eta(version, "intIOR") == 1.5);
    CHECK(eta(version, "int_ior") == 1.5);
  }
  CHECK(read_scene("0.6.0", "<shape type='SPHERE'/>").scene);
  CHECK(read_scene("3.0.0", "<shape type='SPHERE'/>").has("unknown shape type \"SPHERE\""));
  CHECK(read_scene("0.4.0",
                   "<bsdf type='bump'><texture type='checkerboard'/><bsdf type='diffuse'/></bsdf>")
            .scene);
  CHECK(read_bsdf<DiffuseMaterial>(
            "0.6.0", "<bsdf type='diffuse'><rgb name='diffuseReflectance' value='0.1'/></bsdf>")
            .reflectance == ColorInput(Spectrum(0.1f)));
}

TEST_CASE("parameters: the first definition wins, and the caller's over all") {
  const std::string text = scene_text("3.0.0", R"(
    <default name="r" value="2"/><default name="r" value="3"/><default name="radius" value="r"/>
    <default name="twice" value="$r$r"/><default name="type" value="sphere"/>
    <shape type="$type"><float name="${}radius" value="$r"/></shape>)");
  std::string good = text;
  good.replace(good.find("${}"), 3, "");
  const auto radius = [](const ReadResult& r) {
    return r.description().shapes.at(0).to_world[0][0];
  };
  const ReadResult plain = read_text(good);
  REQUIRE_MESSAGE(plain.scene, plain.messages());
  CHECK(radius(plain) == 2);
  using Pairs = std::vector<std::pair<std::string, std::string>>;
  CHECK(plain.scene->parameters ==
        Pairs{{"r", "2"}, {"radius", "r"}, {"twice", "22"}, {"type", "sphere"}});
  const ReadResult defined = read_text(good, {}, {{"r", "5"}, {"unused", "1"}});
  CHECK(radius(defined) == 5);
  CHECK(defined.scene->parameters ==
        Pairs{{"r", "5"}, {"radius", "r"}, {"twice", "55"}, {"type", "sphere"}});
  CHECK(read_text(text).has("undefined parameter \"$\""));
}

TEST_CASE(
    "parameters: the longest name is meant, anywhere in an attribute, as often as one likes") {
  const ReadResult r = read_scene("3.0.0", R"(
    <default name="a" value="1"/><default name="ab" value="2"/>
    <shape type="sphere"><transform name="to_world"><translate value="$a,$ab$a, -$ab.5"/></transform></shape>)");
  REQUIRE_MESSAGE(r.scene, r.messages());
  check_matrix(r.description().shapes[0].to_world,
               {1, 0, 0, 1, 0, 1, 0, 21, 0, 0, 1, -2.5, 0, 0, 0, 1});
  CHECK(read_scene("3.0.0", "<default name='spp' value='1'/><shape type='$sp'/>")
            .has("scene.xml:2:39: error: undefined parameter \"$sp\" (did you mean \"spp\"?)"));
  MemoryFiles files;
  files.texts["/scene/a$b.spd"] = "400 1\n700 1";
  CHECK(read_scene(
            "3.0.0",
            "<emitter type='constant'><spectrum name='radiance' filename='a\\$b.spd'/></emitter>",
            files)
            .scene);
}

TEST_CASE("points and vectors in both spellings") {
  const auto center = [](const std::string& element) {
    const ReadResult r = read_scene("3.0.0", "<shape type='sphere'>" + element + "</shape>");
    if (!r.scene) throw std::runtime_error(r.messages());
    const Matrix4& m = r.description().shapes[0].to_world;
    return std::array<double, 3>{m[0][3], m[1][3], m[2][3]};
  };
  const std::array<double, 3> expected{1, 2, 3};
  CHECK(center("<point name='center' x='1' y='2' z='3'/>") == expected);
  CHECK(center("<point name='center' value='1,2,3'/>") == expected);
  CHECK(center("<vector name='center' value='1 2  3 '/>") == expected);
  CHECK_THROWS(center("<point name='center' x='1' y='2'/>"));
  CHECK_THROWS(center("<point name='center' value='1 2 3' x='1'/>"));
}

TEST_CASE("XML in its less usual forms") {
  CHECK(
      read_text(
          "\xEF\xBB\xBF<?xml version=\"1.0\"?>\r\n<!-- c --><?pi x?>\r\n<scene version='3.0.0'>\r\n"
          "<!-- <shape type='nonsense'/> --><sensor type=\"perspective\"></sensor >"
          "<integrator type='path'/></scene>\r\n<!-- end -->")
          .scene);
  CHECK(
      read_scene("3.0.0", "<shape type='sphere'>&#32;<float name='radius' value='&#50;'/></shape>")
          .scene);
  CHECK(read_scene("3.0.0", "some words")
            .has("scene.xml:1:1: warning: the text \"some words\" in <scene>"));
}

TEST_CASE("what nobody defined stays harmless: entities are not expanded") {
  std::string bomb = "<?xml version='1.0'?><!DOCTYPE s [<!ENTITY a 'aaaaaaaaaa'>";
  for (char c = 'b'; c <= 'z'; ++c)
    bomb += std::string("<!ENTITY ") + c + " '&" + char(c - 1) + ";&" + char(c - 1) + ";'>";
  const ReadResult r = read_text(bomb +
                                 "]><scene version='3.0.0'><shape type='sphere'>"
                                 "<float name='radius' value='&z;'/></shape></scene>");
  CHECK(r.has("error: \"&z;\" is not a finite number"));
}

TEST_CASE("defaults of the whole scene") {
  const ReadResult none = read_text("<scene version='3.0.0'><sensor type='perspective'/></scene>");
  REQUIRE(none.scene);
  CHECK(none.has("warning: the scene has no integrator: \"auto\" is used"));
  CHECK(std::holds_alternative<AutoIntegratorDescription>(none.description().integrator.method));
  CHECK(none.description().approximations.size() == 1);
  CHECK(read_text("<scene version='0.6.0'><sensor type='perspective'/></scene>")
            .has("would use \"direct\""));
  CHECK(read_text("<scene version='0.6.0'><sensor type='perspective'/></scene>")
            .has("would add sun and sky"));
  CHECK(read_text("<scene version='3.0.0'/>").has("the scene has no sensor"));

  const SensorDescription s = none.description().sensors.at(0);
  CHECK(s.near_clip == 1e-2);
  CHECK(s.far_clip == 1e4);
  CHECK(s.film.width == 768);
  CHECK(s.film.height == 576);
  CHECK(s.film.filter.kind == FilterKind::gaussian);
  CHECK(s.sampler == SamplerDescription{"independent", 4, 0});
  // Mitsuba 3.9.1: x_fov = 38.18484115600586
  CHECK(horizontal_fov(s.fov, s.fov_axis, 768.0 / 576) ==
        doctest::Approx(38.18484115600586).epsilon(1e-6));
}

TEST_CASE("0.x renders its last sensor, 3.x its first") {
  const std::string two = "<sensor type='perspective' id='a'/><sensor type='orthographic' id='b'/>";
  CHECK(
      read_text("<scene version='0.6.0'>" + two + "</scene>").description().sensors[0].label.text ==
      "b");
  CHECK(
      read_text("<scene version='3.0.0'>" + two + "</scene>").description().sensors[0].label.text ==
      "a");
}

TEST_CASE("ten thousand shapes are read quickly") {
  std::string content;
  for (int i = 0; i < 10000; ++i)
    content += "<shape type='sphere' id='s" + std::to_string(i) +
               "'><transform name='to_world'><translate x='" + std::to_string(i) +
               "'/></transform><bsdf type='diffuse'/></shape>\n";
  const ReadResult r = read_scene("3.0.0", content);
  REQUIRE(r.scene);
  CHECK(r.description().shapes.size() == 10000);
  CHECK(r.description().shapes[9999].where.line == 10001);
}
