// What each plugin's parameters become. Values that Mitsuba sets itself are those of 3.9.1.
#include <doctest/doctest.h>

#include "support/memory_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

MemoryFiles image() {
  MemoryFiles files;
  for (const char* name : {"a.png", "b.exr", "a.obj", "a.ply", "a.serialized"})
    files.texts[std::string("/scene/") + name] = "x";
  return files;
}

SceneDescription good(const std::string& version, const std::string& content) {
  const ReadResult r = read_scene(version, content, image());
  if (!r.scene) throw std::runtime_error(r.messages());
  return r.description();
}

template <class M>
M bsdf(const std::string& version, const std::string& type, const std::string& content = "") {
  const SceneDescription d = good(version, "<bsdf type='" + type + "'>" + content + "</bsdf>");
  return std::get<M>(d.materials.back().model);
}

template <class T>
T texture(const std::string& version, const std::string& type, const std::string& content = "") {
  const SceneDescription d =
      good(version, "<texture type='" + type + "'>" + content + "</texture>");
  return std::get<T>(d.textures.back().model);
}

template <class L>
std::pair<L, Matrix4> light(const std::string& version, const std::string& type,
                            const std::string& content = "") {
  const SceneDescription d =
      good(version, "<emitter type='" + type + "'>" + content + "</emitter>");
  return {std::get<L>(d.lights.at(0).model), d.lights.at(0).to_world};
}

SensorDescription sensor(const std::string& version, const std::string& type,
                         const std::string& content = "") {
  const ReadResult r =
      read_text("<scene version='" + version + "'><integrator type='path'/><sensor type='" + type +
                "'>" + content + "</sensor></scene>");
  if (!r.scene) throw std::runtime_error(r.messages());
  return r.description().sensors.at(0);
}

FilmDescription film(const std::string& version, const std::string& type,
                     const std::string& content) {
  return sensor(version, "perspective", "<film type='" + type + "'>" + content + "</film>").film;
}

IntegratorDescription integrator(const std::string& version, const std::string& element) {
  const ReadResult r = read_text("<scene version='" + version + "'><sensor type='perspective'/>" +
                                 element + "</scene>");
  if (!r.scene) throw std::runtime_error(r.messages());
  return r.description().integrator;
}

bool fails(const std::string& version, const std::string& content, const std::string& message) {
  const ReadResult r = read_scene(version, content, image());
  INFO(r.messages());
  CHECK(!r.scene);
  return r.has(message);
}

const std::string kBoard = "<texture type='checkerboard'/>";

}  // namespace

TEST_CASE("bsdf: presets") {
  CHECK(bsdf<DiffuseMaterial>("3.0.0", "diffuse") == DiffuseMaterial{});
  CHECK(bsdf<DielectricMaterial>("3.0.0", "dielectric") == DielectricMaterial{});
  CHECK(bsdf<ThinDielectricMaterial>("3.0.0", "thindielectric") == ThinDielectricMaterial{});
  CHECK(bsdf<PlasticMaterial>("3.0.0", "plastic") == PlasticMaterial{});
  CHECK(bsdf<ConductorMaterial>("3.0.0", "conductor") == ConductorMaterial{});
  CHECK(bsdf<PrincipledMaterial>("3.0.0", "principled") == PrincipledMaterial{});
  CHECK(bsdf<PrincipledThinMaterial>("3.0.0", "principledthin") == PrincipledThinMaterial{});
  CHECK(bsdf<NullMaterial>("3.0.0", "null") == NullMaterial{});
  for (const char* version : {"0.6.0", "3.0.0"}) {
    CHECK(*bsdf<DielectricMaterial>(version, "roughdielectric").roughness == Roughness{});
    CHECK(*bsdf<PlasticMaterial>(version, "roughplastic").roughness == Roughness{});
    CHECK(*bsdf<ConductorMaterial>(version, "roughconductor").roughness == Roughness{});
  }
}

TEST_CASE("bsdf: roughness") {
  const auto r = [](const std::string& version, const std::string& content) {
    return *bsdf<ConductorMaterial>(version, "roughconductor", content).roughness;
  };
  CHECK(r("3.0.0", "<string name='distribution' value='GGX'/>").distribution ==
        MicrofacetDistribution::ggx);
  CHECK(r("3.0.0", "<float name='alpha' value='0.3'/>").alpha_v == FloatInput(0.3));
  CHECK(r("3.0.0", "<float name='alpha' value='0'/>").alpha_u == FloatInput(1e-4));
  const Roughness uv =
      r("0.6.0", "<float name='alphaU' value='0.1'/><float name='alphaV' value='0.2'/>");
  CHECK(uv.alpha_u == FloatInput(0.1));
  CHECK(uv.alpha_v == FloatInput(0.2));
  CHECK(!r("0.6.0", "<boolean name='sampleVisible' value='false'/>").sample_visible);
  CHECK(r("3.0.0", "<texture name='alpha' type='checkerboard'/>").alpha_u ==
        FloatInput(TextureId{0}));
  // Mitsuba 3 takes the mean of a colour where it needs a number.
  CHECK(std::get<double>(r("3.0.0", "<rgb name='alpha' value='0.1 0.2 0.6'/>").alpha_u) ==
        doctest::Approx(0.3));
  const ReadResult phong = read_scene("0.6.0",
                                      "<bsdf type='roughconductor'>\n<string name='distribution' "
                                      "value='phong'/></bsdf>");
  CHECK(phong.has("scene.xml:3:29: warning: the Phong microfacet distribution is approximated"));
  CHECK(phong.description().approximations.size() == 2);  // and no light in the scene
  CHECK(fails("3.0.0",
              "<bsdf type='roughplastic'><string name='distribution' value='blinn'/></bsdf>",
              "it is one of beckmann, ggx"));
  CHECK(fails("3.0.0", "<bsdf type='roughconductor'><float name='alpha_u' value='1'/></bsdf>",
              "together"));
  CHECK(fails("3.0.0",
              "<bsdf type='roughconductor'><float name='alpha' value='1'/><float name='alpha_u' "
              "value='1'/><float name='alpha_v' value='1'/></bsdf>",
              "either \"alpha\""));
  CHECK(fails("3.0.0", "<bsdf type='roughconductor'><float name='alpha' value='-1'/></bsdf>",
              "negative"));
}

TEST_CASE("bsdf: parameters") {
  const auto plastic = bsdf<PlasticMaterial>("0.6.0", "roughplastic", R"(
      <string name="intIOR" value="diamond"/><float name="extIOR" value="1"/>
      <rgb name="diffuseReflectance" value=".1 .2 .3"/><float name="specularReflectance" value="0.5"/>
      <boolean name="nonlinear" value="true"/><float name="alpha" value="0.25"/>)");
  CHECK(plastic.eta == 2.419);
  CHECK(plastic.diffuse_reflectance == ColorInput(Spectrum(0.1f, 0.2f, 0.3f)));
  CHECK(plastic.specular_reflectance == ColorInput(Spectrum(0.5f)));
  CHECK(plastic.nonlinear);
  CHECK(plastic.roughness->alpha_u == FloatInput(0.25));

  const auto glass = bsdf<DielectricMaterial>("3.0.0", "dielectric",
                                              "<float name='specular_reflectance' value='0'/><rgb "
                                              "name='specular_transmittance' value='.1 .2 .3'/>");
  CHECK(glass.specular_reflectance == ColorInput(Spectrum(0.0f)));
  CHECK(glass.specular_transmittance == ColorInput(Spectrum(0.1f, 0.2f, 0.3f)));

  const auto p = bsdf<PrincipledMaterial>("3.0.0", "principled", R"(
      <rgb name="base_color" value="0.2,0.8,0.1 "/><float name="roughness" value="0.15"/>
      <texture name="anisotropic" type="checkerboard"/><float name="metallic" value="0.1"/>
      <float name="spec_trans" value="0.2"/><float name="spec_tint" value="0.3"/>
      <float name="sheen" value="0.4"/><float name="sheen_tint" value="0.5"/>
      <float name="flatness" value="0.6"/><float name="clearcoat" value="0.7"/>
      <float name="clearcoat_gloss" value="0.8"/><float name="specular" value="0.9"/>
      <float name="clearcoat_sampling_rate" value="2"/>)");
  PrincipledMaterial expected;
  expected.base_color = Spectrum(0.2f, 0.8f, 0.1f);
  expected.roughness = 0.15;
  expected.anisotropic = TextureId{0};
  expected.metallic = 0.1;
  expected.spec_trans = 0.2;
  expected.spec_tint = 0.3;
  expected.sheen = 0.4;
  expected.sheen_tint = 0.5;
  expected.flatness = 0.6;
  expected.clearcoat = 0.7;
  expected.clearcoat_gloss = 0.8;
  expected.specular = 0.9;
  expected.clearcoat_sampling_rate = 2;
  CHECK(p == expected);
  CHECK(fails("3.0.0",
              "<bsdf type='principled'><float name='eta' value='1.2'/><float name='specular' "
              "value='1'/></bsdf>",
              "either \"eta\" or \"specular\""));
  const auto thin = bsdf<PrincipledThinMaterial>(
      "3.0.0", "principledthin",
      "<float name='eta' value='1.3'/><float name='diff_trans' value='2'/>");
  CHECK(thin.eta == FloatInput(1.3));
  CHECK(thin.diff_trans == FloatInput(2.0));
  CHECK(fails("3.0.0",
              "<bsdf type='roughdielectric'><float name='int_ior' value='1'/><float name='ext_ior' "
              "value='1'/></bsdf>",
              "must differ"));
  CHECK(fails("3.0.0",
              "<bsdf type='conductor'><string name='material' value='Cu'/><rgb name='eta' "
              "value='1'/></bsdf>",
              "either \"material\""));
}

TEST_CASE("bsdf: those that hold others") {
  const std::string grey = "<bsdf type='diffuse'/>", glass = "<bsdf type='dielectric'/>";
  const auto one = bsdf<TwoSidedMaterial>("3.0.0", "twosided", grey);
  CHECK(one.front == one.back);
  const auto two = bsdf<TwoSidedMaterial>("0.6.0", "twosided", grey + "<bsdf type='plastic'/>");
  CHECK(size_t(two.front) == 0);
  CHECK(size_t(two.back) == 1);
  CHECK(bsdf<MaskMaterial>("3.0.0", "mask", grey).opacity == FloatInput(0.5));
  CHECK(bsdf<MaskMaterial>("3.0.0", "mask", grey + "<texture name='opacity' type='checkerboard'/>")
            .opacity == FloatInput(TextureId{0}));
  const auto blend = bsdf<BlendMaterial>("0.6.0", "blendbsdf",
                                         grey + glass + "<float name='weight' value='0.2'/>");
  CHECK(blend.weight == FloatInput(0.2));
  CHECK(size_t(blend.second) == 1);

  const auto bump3 =
      bsdf<BumpMapMaterial>("3.0.0", "bumpmap", kBoard + "<float name='scale' value='2'/>" + grey);
  CHECK(bump3.scale == 2);
  CHECK(bump3.use_shadowing_function);
  const auto bump0 = bsdf<BumpMapMaterial>(
      "0.6.0", "bumpmap",
      grey + "<texture type='scale'><float name='scale' value='10'/>" + kBoard + "</texture>");
  CHECK(bump0.scale == 10);
  CHECK(!bump0.use_shadowing_function);
  CHECK(bsdf<NormalMapMaterial>("3.0.0", "normalmap",
                                grey + "<texture name='normalmap' type='checkerboard'/>")
            .flip_invalid_normals);
  CHECK(!bsdf<NormalMapMaterial>("0.6.0", "normalmap", grey + kBoard).flip_invalid_normals);

  // A colour is an opacity per channel in 0.6; a number in Mitsuba 3: (0.2 + 0.3 + 0.4) / 3.
  const std::string coloured = grey + "<rgb name='opacity' value='.2 .3 .4'/>";
  CHECK(std::get<double>(bsdf<MaskMaterial>("3.0.0", "mask", coloured).opacity) ==
        doctest::Approx(0.3));
  CHECK(std::get<double>(bsdf<MaskMaterial>("0.6.0", "mask", coloured).opacity) ==
        doctest::Approx(0.2859498));

  CHECK(fails("3.0.0", "<bsdf type='twosided'/>", "needs 1 or 2 nested BSDFs, not 0"));
  CHECK(fails("3.0.0", "<bsdf type='twosided'>" + grey + grey + grey + "</bsdf>", "not 3"));
  CHECK(fails("3.0.0", "<bsdf type='twosided'>" + glass + "</bsdf>", "lets light through"));
  CHECK(fails("3.0.0", "<bsdf type='twosided'><bsdf type='mask'>" + grey + "</bsdf></bsdf>",
              "lets light through"));
  CHECK(
      fails("3.0.0", "<bsdf type='blendbsdf'>" + grey + "</bsdf>", "needs 2 nested BSDFs, not 1"));
  CHECK(fails("3.0.0", "<bsdf type='bumpmap'>" + grey + "</bsdf>", "needs one texture, not 0"));
}

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
  const auto scaled = texture<CheckerboardTexture>("0.6.0", "scale",
                                                   kBoard + "<rgb name='scale' value='0.5 1 2'/>");
  CHECK(scaled.color0 == ColorInput(Spectrum(0.2f, 0.4f, 0.8f)));
  CHECK(fails("0.6.0",
              "<texture type='scale'><float name='scale' value='2'/><texture type='bitmap'><string "
              "name='filename' value='a.png'/></texture></texture>",
              "not supported yet"));
}

TEST_CASE("shape: places and orientation") {
  const auto shape = [](const std::string& version, const std::string& type,
                        const std::string& content) {
    return good(version, "<shape type='" + type + "'>" + content + "</shape>").shapes.at(0);
  };
  const std::string stretched = "<transform name='to_world'><scale x='2'/></transform>";
  // Mitsuba 3.9.1: [[4, 0, 0, 2], [0, 2, 0, 1], [0, 0, 2, 1]]
  CHECK(shape("3.0.0", "sphere",
              "<point name='center' value='1 1 1'/><float name='radius' value='2'/>" + stretched)
            .to_world == Matrix4{{{{4, 0, 0, 2}, {0, 2, 0, 1}, {0, 0, 2, 1}, {0, 0, 0, 1}}}});
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
  CHECK(fails("3.0.0", "<shape type='sphere'><float name='radius' value='0'/></shape>",
              "must be positive, not 0"));
  CHECK(fails("3.0.0", "<shape type='cylinder'><point name='p1' value='0 0 0'/></shape>",
              "the same point"));
}

TEST_CASE("shape: meshes") {
  const auto mesh = [](const std::string& version, const std::string& type,
                       const std::string& content) {
    return std::get<MeshShape>(good(version, "<shape type='" + type +
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

TEST_CASE("shape: materials of OBJ files") {
  MemoryFiles files;
  files.texts = {{"/scene/one.obj", "mtllib x.mtl\r\nusemtl Glass\r\nf 1 2 3\n"},
                 {"/scene/two.obj", "usemtl A\nf 1 2 3\nusemtl B\nf 1 2 3\n"}};
  const auto read = [&](const std::string& version, const std::string& name,
                        const std::string& content) {
    return read_scene(
        version,
        "<shape type='obj'><string name='filename' value='" + name + "'/>" + content + "</shape>",
        files);
  };
  const std::string named = "<bsdf name='Glass' type='dielectric'/>";
  CHECK(read("0.6.0", "one.obj", named).scene);
  CHECK(read("0.6.0", "two.obj", "<bsdf name='A' type='diffuse'/>")
            .has("for the 2 parts of an OBJ file"));
  CHECK(read("0.6.0", "two.obj", "<bsdf type='diffuse'/>").scene);
  CHECK(read("0.6.0", "one.obj", "")
            .has("warning: the materials of OBJ files (mtllib) are not read"));
  CHECK(!read("0.6.0", "one.obj", "<boolean name='loadMaterials' value='false'/>").has("mtllib"));
  CHECK(!read("3.0.0", "one.obj", "").has("mtllib"));
}

TEST_CASE("shape: material by default, black under a light") {
  const SceneDescription d =
      good("3.0.0",
           "<shape type='sphere'/><shape type='cube'><emitter type='area'/></shape>"
           "<shape type='disk'/>");
  const auto reflectance = [&](size_t i) {
    return std::get<DiffuseMaterial>(d.materials[size_t(d.shapes[i].material)].model).reflectance;
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

TEST_CASE("emitters") {
  const auto spot =
      light<SpotLight>("0.6.0", "spot",
                       "<float name='cutoffAngle' value='40'/><texture name='texture' "
                       "type='checkerboard'/>")
          .first;
  CHECK(spot.cutoff_angle == 40);
  CHECK(spot.beam_width == 30);
  CHECK(spot.texture == TextureId{0});
  CHECK(light<SpotLight>("3.0.0", "spot").first == SpotLight{});
  CHECK(fails("3.0.0", "<emitter type='spot'><float name='beam_width' value='30'/></emitter>",
              "greater than the cutoff angle"));

  const auto [projector, at] =
      light<ProjectorLight>("3.0.0", "projector",
                            "<float name='fov' value='30'/><string name='fov_axis' "
                            "value='y'/><float name='scale' value='4'/>"
                            "<transform name='to_world'><translate x='5'/></transform>");
  CHECK(projector.fov == 30);
  CHECK(projector.fov_axis == FovAxis::y);
  CHECK(projector.scale == 4);
  CHECK(at[0][3] == 5);
  const auto lens = light<ProjectorLight>("3.0.0", "projector").first;
  CHECK(lens.fov_axis == FovAxis::diagonal);
  CHECK(lens.fov == doctest::Approx(46.7930));

  const auto sun = light<DirectionalLight>(
      "3.0.0", "directional",
      "<vector name='direction' value='1 2 3'/><rgb name='irradiance' value='2'/>");
  CHECK(sun.first.irradiance == Spectrum(2.0f));
  CHECK(sun.second[0][2] == doctest::Approx(0.267261));
  CHECK(sun.second[1][2] == doctest::Approx(0.534522));
  CHECK(sun.second[2][2] == doctest::Approx(0.801784));
  CHECK(sun.second.determinant3() == doctest::Approx(1));
  CHECK(fails("3.0.0",
              "<emitter type='directional'><vector name='direction' value='0 0 0'/></emitter>",
              "cannot be zero"));
  CHECK(fails("3.0.0",
              "<emitter type='point'><point name='position' value='1 2 3'/><transform "
              "name='to_world'/></emitter>",
              "either \"position\" or \"to_world\""));
  CHECK(light<PointLight>("3.0.0", "point",
                          "<transform name='to_world'><lookat origin='1 2 3' target='0 0 0' "
                          "up='0 1 0'/></transform>")
            .second == Matrix4::translate(1, 2, 3));

  const auto map = light<EnvironmentMapLight>(
      "0.6.0", "envmap",
      "<string name='filename' value='b.exr'/><float name='scale' value='2'/>"
      "<float name='gamma' value='-1'/><boolean name='cache' value='false'/>");
  CHECK(map.first == EnvironmentMapLight{"/scene/b.exr", 2, -1.0});
  CHECK(fails("3.0.0", "<emitter type='constant'/><emitter type='constant'/>",
              "one environment only"));
  CHECK(fails("3.0.0",
              "<emitter type='point'><texture name='intensity' type='checkerboard'/></emitter>",
              "cannot be a texture"));
  CHECK(good("3.0.0", "<emitter type='point'><float name='sampling_weight' value='3'/></emitter>")
            .lights[0]
            .sampling_weight == 3);
}

TEST_CASE("sensors") {
  // x_fov of Mitsuba 3.9.1 for 768 × 576 pixels
  const auto xfov = [](const std::string& content) {
    const SensorDescription s = sensor("3.0.0", "perspective", content);
    return horizontal_fov(s.fov, s.fov_axis, 768.0 / 576);
  };
  CHECK(xfov("<string name='focal_length' value='35 mm'/>") ==
        doctest::Approx(52.62254333496094).epsilon(1e-6));
  CHECK(xfov("<string name='focal_length' value='50'/>") ==
        doctest::Approx(38.18484115600586).epsilon(1e-6));
  CHECK(xfov("<float name='fov' value='40'/>") == doctest::Approx(40));
  CHECK(xfov("<float name='fov' value='40'/><string name='fov_axis' value='Smaller'/>") > 40);

  const SensorDescription p = sensor("3.0.0", "perspective",
                                     "<float name='principal_point_offset_x' value='0.1'/>"
                                     "<float name='principal_point_offset_y' value='-0.2'/>"
                                     "<float name='focus_distance' value='3'/>");
  CHECK(p.principal_point_offset_x == 0.1);
  CHECK(p.principal_point_offset_y == -0.2);
  const SensorDescription lens =
      sensor("3.0.0", "thinlens", "<float name='aperture_radius' value='0.5'/>");
  CHECK(lens.aperture_radius == 0.5);
  CHECK(lens.focus_distance == 10000);
  CHECK(
      sensor("3.0.0", "orthographic", "<transform name='to_world'><scale x='2' y='2'/></transform>")
          .to_world[0][0] == 2);

  const auto bad = [](const std::string& type, const std::string& content,
                      const std::string& message) {
    return read_text("<scene version='3.0.0'><sensor type='" + type + "'>" + content +
                     "</sensor></scene>")
        .has(message);
  };
  CHECK(bad("thinlens", "", "needs the parameter \"aperture_radius\""));
  CHECK(bad("perspective", "<float name='fov' value='180'/>", "must be between 0 and 180"));
  CHECK(bad("perspective", "<float name='near_clip' value='0'/>", "must be positive"));
  CHECK(bad("perspective", "<float name='near_clip' value='3'/><float name='far_clip' value='2'/>",
            "not smaller"));
  CHECK(bad("perspective",
            "<float name='fov' value='40'/><string name='focal_length' value='35mm'/>",
            "either \"fov\" or \"focal_length\""));
  CHECK(bad("perspective", "<transform name='to_world'><scale x='2'/></transform>",
            "must not scale"));
  CHECK(!bad("perspective", "<transform name='to_world'><scale x='-1'/></transform>",
             "must not scale"));
  CHECK(
      bad("perspective", "<film type='hdrfilm'/><film type='hdrfilm'/>", "can have only one film"));
  CHECK(bad("perspective", "<string name='fov_axis' value='y'/>",
            "warning: the parameter \"fov_axis\""));
}

TEST_CASE("films and filters") {
  const FilmDescription f =
      film("3.0.0", "hdrfilm",
           "<integer name='width' value='100'/><integer name='height' value='50'/>"
           "<integer name='crop_width' value='10'/><string name='pixel_format' value='RGBA'/>"
           "<string name='component_format' value='Float32'/>");
  CHECK(f.width == 100);
  CHECK(f.crop == CropWindow{0, 0, 10, 50});
  CHECK(f.pixel_format == PixelFormat::rgba);
  CHECK(f.component_format == ComponentFormat::single);
  CHECK(!film("3.0.0", "hdrfilm", "<integer name='crop_width' value='768'/>").crop);
  CHECK(!f.tone_mapping);

  const FilmDescription ldr =
      film("0.6.0", "ldrfilm",
           "<string name='tonemapMethod' value='reinhard'/><float name='exposure' value='1.5'/>"
           "<float name='key' value='0.3'/><float name='burn' value='0.1'/><float name='gamma' "
           "value='2.2'/>");
  CHECK(ldr.tone_mapping == ToneMapping{true, 2.2, 1.5, 0.3, 0.1});
  CHECK(film("0.6.0", "ldrfilm", "").tone_mapping == ToneMapping{});

  const auto filter = [](const std::string& type, const std::string& content = "") {
    return film("3.0.0", "hdrfilm", "<rfilter type='" + type + "'>" + content + "</rfilter>")
        .filter;
  };
  // Radii of Mitsuba 3.9.1's filters.
  CHECK(filter_radius(filter("box")) == 0.5);
  CHECK(filter_radius(filter("tent")) == 1);
  CHECK(filter_radius(filter("gaussian")) == 2);
  CHECK(filter_radius(filter("mitchell")) == 2);
  CHECK(filter_radius(filter("catmullrom")) == 2);
  CHECK(filter_radius(filter("lanczos")) == 3);
  CHECK(filter("gaussian", "<float name='stddev' value='0.3'/>").stddev == 0.3);
  CHECK(filter("tent", "<float name='radius' value='2'/>").radius == 2);
  CHECK(filter("mitchell", "<float name='B' value='0.2'/><float name='C' value='0.4'/>").c == 0.4);
  CHECK(filter("lanczos", "<integer name='lobes' value='4'/>").lobes == 4);

  const auto bad = [](const std::string& content, const std::string& message) {
    return read_text("<scene version='3.0.0'><sensor type='perspective'><film type='hdrfilm'>" +
                     content + "</film></sensor></scene>")
        .has(message);
  };
  CHECK(bad("<integer name='width' value='0'/>", "must be from 1 to 65536, not 0"));
  CHECK(bad("<integer name='width' value='1000000000'/>", "must be from 1 to 65536"));
  CHECK(bad("<integer name='width' value='60000'/><integer name='height' value='60000'/>",
            "is too large"));
  CHECK(bad("<integer name='crop_offset_x' value='10'/>", "does not lie in the image"));
  CHECK(bad("<string name='component_format' value='uint32'/>", "it is one of float16, float32"));
  CHECK(bad("<rfilter type='gaussian'><float name='stddev' value='1e6'/></rfilter>", "too wide"));
  CHECK(bad("<boolean name='banner' value='true'/>", "warning: the parameter \"banner\""));
  CHECK(!bad("<boolean name='banner' value='false'/>", "banner"));
}

TEST_CASE("samplers") {
  for (const char* name : {"independent", "stratified", "multijitter", "orthogonal", "ldsampler",
                           "sobol", "halton", "hammersley"}) {
    const SamplerDescription s = sensor("0.6.0", "perspective",
                                        std::string("<sampler type='") + name +
                                            "'><integer name='sampleCount' value='9'/>"
                                            "<integer name='seed' value='3'/></sampler>")
                                     .sampler;
    CHECK(s == SamplerDescription{name, 9, 3});
  }
}

TEST_CASE("integrators") {
  using Path = PathIntegratorDescription;
  using Direct = DirectIntegratorDescription;
  CHECK(std::get<Path>(integrator("3.0.0", "<integrator type='path'/>").method) == Path{});
  CHECK(std::get<Path>(integrator("0.6.0",
                                  "<integrator type='path'><integer name='maxDepth' value='-1'/>"
                                  "<boolean name='strictNormals' value='true'/></integrator>")
                           .method)
            .strict_normals);
  CHECK(
      std::get<Direct>(
          integrator(
              "3.0.0",
              "<integrator type='direct'><integer name='shading_samples' value='3'/></integrator>")
              .method) == Direct{3, 3, false, false});
  CHECK(std::get<Direct>(
            integrator("0.6.0",
                       "<integrator type='direct'><integer name='shadingSamples' value='3'/>"
                       "<integer name='bsdfSamples' value='2'/></integrator>")
                .method) == Direct{3, 2, false, false});
  CHECK(std::holds_alternative<DepthIntegratorDescription>(
      integrator("3.0.0", "<integrator type='depth'/>").method));

  const IntegratorDescription aov = integrator(
      "3.0.0",
      "<integrator type='aov'><string name='aovs' value='dd:depth, nn:sh_normal,a:albedo'/>"
      "<integrator type='moment'><integrator type='direct'/></integrator></integrator>");
  CHECK(aov.aovs.layers.size() == 3);
  CHECK(aov.aovs.layers[1].kind == "sh_normal");
  CHECK(aov.aovs.layers[1].name == "nn");
  CHECK(aov.moments);
  CHECK(aov.image);
  CHECK(std::holds_alternative<Direct>(aov.method));
  CHECK(!integrator("3.0.0",
                    "<integrator type='aov'><string name='aovs' value='d:depth'/></integrator>")
             .image);

  const auto bad = [](const std::string& element, const std::string& message) {
    return read_text("<scene version='3.0.0'><sensor type='perspective'/>" + element + "</scene>")
        .has(message);
  };
  CHECK(bad("<integrator type='path'><integer name='max_depth' value='-2'/></integrator>",
            "must be -1 or more"));
  CHECK(bad("<integrator type='path'><integer name='rr_depth' value='0'/></integrator>",
            "must be positive"));
  CHECK(
      bad("<integrator type='direct'><integer name='emitter_samples' value='0'/>"
          "<integer name='bsdf_samples' value='0'/></integrator>",
          "at least one sample"));
  CHECK(bad("<integrator type='aov'><string name='aovs' value='d:foo'/></integrator>",
            "unknown kind of layer"));
  CHECK(bad("<integrator type='aov'><string name='aovs' value='d:depht'/></integrator>",
            "(did you mean \"depth\"?)"));
  CHECK(bad("<integrator type='aov'><string name='aovs' value='depth'/></integrator>",
            "form name:kind"));
  CHECK(bad("<integrator type='aov'/>", "needs the parameter \"aovs\""));
  CHECK(bad("<integrator type='moment'/>", "needs an integrator"));
  CHECK(bad("<integrator type='path'/><integrator type='path'/>", "can have only one integrator"));
  CHECK(bad("<integrator type='volpath'/>", "integrator type \"volpath\" is not supported yet"));
}
