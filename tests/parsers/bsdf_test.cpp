// What the parameters of BSDFs become. Values that Mitsuba sets itself are those of 3.9.1.
#include <doctest/doctest.h>

#include "parsers/plugin_checks.h"

using namespace duet;
using namespace duet::test;

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

namespace {

/// What the file leaves open is what the description begins with, also where a default is the name
/// of a material or one of several that a roughness has.
template <class M>
void check_defaults(const M& initial = {}, const std::string& inside = "") {
  const std::string type = initial.name();
  CAPTURE(type);
  const M read = read_bsdf<M>("3.0.0", "<bsdf type='" + type + "'>" + inside + "</bsdf>");
  CHECK(MaterialModel(read) == MaterialModel(initial));
}

template <class M>
M rough() {
  M m;
  m.roughness.emplace();
  return m;
}

}  // namespace

TEST_CASE("bsdf: defaults are those of the descriptions") {
  check_defaults<DiffuseMaterial>();
  check_defaults<ConductorMaterial>();
  check_defaults<ConductorMaterial>(rough<ConductorMaterial>());
  check_defaults<DielectricMaterial>();
  check_defaults<DielectricMaterial>(rough<DielectricMaterial>());
  check_defaults<ThinDielectricMaterial>();
  check_defaults<PlasticMaterial>();
  check_defaults<PlasticMaterial>(rough<PlasticMaterial>());
  check_defaults<PolarizedPlasticMaterial>();
  check_defaults<PrincipledMaterial>();
  check_defaults<PrincipledThinMaterial>();
  check_defaults<PhongMaterial>();
  check_defaults<WardMaterial>();
  check_defaults<RoughDiffuseMaterial>();
  check_defaults<DiffuseTransmitterMaterial>();
  check_defaults<HairMaterial>();
  check_defaults<CoatedDiffuseMaterial>();
  check_defaults<CoatedConductorMaterial>();
  check_defaults<SubstrateMaterial>();
  check_defaults<UberMaterial>();
}

TEST_CASE("bsdf: models of 0.6 that Mitsuba 3 has not") {
  for (const char* version : {"0.6.0", "3.0.0"}) {
    CHECK(bsdf<PhongMaterial>(version, "phong") == PhongMaterial{});
    CHECK(bsdf<WardMaterial>(version, "ward") == WardMaterial{});
    CHECK(bsdf<RoughDiffuseMaterial>(version, "roughdiffuse") == RoughDiffuseMaterial{});
    CHECK(bsdf<DiffuseTransmitterMaterial>(version, "difftrans") == DiffuseTransmitterMaterial{});
  }
  const auto ward = bsdf<WardMaterial>("0.6.0", "ward",
                                       "<string name='variant' value='ward-duer'/>"
                                       "<float name='alphaU' value='0.3'/>");
  CHECK(ward.variant == WardVariant::duer);
  CHECK(ward.alpha_u == FloatInput(0.3));
  CHECK(bsdf<RoughDiffuseMaterial>("0.6.0", "roughdiffuse",
                                   "<boolean name='useFastApprox' value='true'/>")
            .use_fast_approx);
  // Lobes that reflect more than there is are scaled, as 0.6 does.
  const std::string bright =
      "<bsdf type='phong'><spectrum name='specularReflectance' value='0.8'/>"
      "<spectrum name='diffuseReflectance' value='0.7'/></bsdf>";
  const ReadResult phong = read_scene("0.6.0", bright);
  CHECK(phong.has("<bsdf type=\"phong\"> would reflect 1.5 times the light"));
  const auto& scaled = phong.description().materials[0].model.get<PhongMaterial>();
  CHECK(std::get<Spectrum>(scaled.specular_reflectance).r == doctest::Approx(0.8 * 0.66));
  CHECK(fails("0.6.0", "<bsdf type='phong'><float name='exponent' value='-1'/></bsdf>",
              "an exponent must not be negative"));

  const std::string two = "<bsdf type='diffuse'/><bsdf type='phong'/></bsdf>";
  const std::string mixture = "<bsdf type='mixturebsdf'><string name='weights' value=";
  const auto parts = bsdf<MixtureMaterial>("0.6.0", "mixturebsdf",
                                           "<string name='weights' value='0.6, 1.4'/>"
                                           "<bsdf type='diffuse'/><bsdf type='phong'/>")
                         .parts;
  REQUIRE(parts.size() == 2);
  CHECK(parts[0].first == doctest::Approx(0.3));
  CHECK(parts[1].first == doctest::Approx(0.7));
  CHECK(fails("0.6.0", mixture + "'0.5'/>" + two, "needs 1 nested BSDF, not 2"));
  CHECK(fails("0.6.0", mixture + "'0.5, -1'/>" + two, "are not weights"));
  CHECK(fails("0.6.0", mixture + "''/>" + two, "are not weights"));
  CHECK(fails("0.6.0", "<bsdf type='twosided'><bsdf type='difftrans'/></bsdf>",
              "cannot hold a BSDF that lets light through"));
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

  // What is the same everywhere can be a map, too.
  const auto normals = [&](const std::string& value) {
    return bsdf<NormalMapMaterial>("3.0.0", "normalmap", grey + value).normals;
  };
  CHECK(normals("<texture name='normalmap' type='rawconstant'>"
                "<vector name='value' value='.2 .3 .9'/></texture>") ==
        ColorInput(Spectrum(0.2f, 0.3f, 0.9f)));
  CHECK(normals("<rgb name='normalmap' value='.2 .3 .9'/>") ==
        ColorInput(Spectrum(0.2f, 0.3f, 0.9f)));
  CHECK(normals("<float name='normalmap' value='.7'/>") == ColorInput(Spectrum(0.7f)));
  CHECK(bsdf<BumpMapMaterial>(
            "3.0.0", "bumpmap",
            "<texture type='uniform'><float name='value' value='0.25'/></texture>" + grey)
            .height == FloatInput(0.25));

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
