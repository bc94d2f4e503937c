// Media, phase functions and volumes of both Mitsubas.
#include <doctest/doctest.h>

#include "mitsuba/writer.h"
#include "support/memory_scene.h"
#include "support/volume_files.h"

using namespace duet;
using namespace duet::test;

namespace {

MemoryFiles files() {
  MemoryFiles f;
  f.texts["/scene/smoke.vol"] = float_volume(2, 1, 1, 1, {1, 2});
  f.texts["/scene/flakes.vol"] = float_volume(1, 1, 1, 6, {1, 1, 1, 0, 0, 0});
  VolumeText bytes;
  bytes.encoding = 3;
  bytes.values = "ab";
  f.texts["/scene/bytes.vol"] = bytes.text();
  f.texts["/scene/broken.vol"] = "VOL\x07";
  return f;
}

ReadResult read(const std::string& version, const std::string& content) {
  return read_scene(version, content, files());
}

/// The first medium of a scene with this content of <medium>.
SceneDescription scene_of(const std::string& version, const std::string& type,
                          const std::string& content) {
  ReadResult r = read(version, "<medium id='m' type='" + type + "'>" + content + "</medium>");
  REQUIRE_MESSAGE(r.scene, r.messages());
  return r.scene->description;
}

MediumDescription homogeneous(const std::string& version, const std::string& content) {
  return scene_of(version, "homogeneous", content).media.at(0);
}

void check_constant(const ColorVolume& volume, double r, double g, double b) {
  const Spectrum s = std::get<Spectrum>(volume);
  CHECK(s.r == doctest::Approx(r).epsilon(1e-5));
  CHECK(s.g == doctest::Approx(g).epsilon(1e-5));
  CHECK(s.b == doctest::Approx(b).epsilon(1e-5));
}

}  // namespace

TEST_CASE("media say what their ways of sampling change in Mitsuba 3") {
  const auto messages = [](const std::string& content) {
    return read("3.0.0", "<medium type='homogeneous'>" + content + "</medium>").messages();
  };
  const std::string no_samples = "<boolean name='sample_emitters' value='false'/>",
                    one_colour = "<boolean name='has_spectral_extinction' value='false'/>",
                    coloured = "<rgb name='sigma_t' value='1 2 3'/>";
  CHECK(messages(no_samples).find("light that no ray can hit") != std::string::npos);
  CHECK(messages(coloured + one_colour).find("every colour has its own") != std::string::npos);
  CHECK(messages(one_colour).find("every colour") == std::string::npos);
  CHECK(messages(coloured).find("every colour") == std::string::npos);
}

TEST_CASE("homogeneous media of Mitsuba 3") {
  const MediumDescription preset = homogeneous("3.0.0", "");
  check_constant(preset.sigma_t, 1, 1, 1);
  check_constant(preset.albedo, 0.75, 0.75, 0.75);
  CHECK(preset.scale == 1);
  const MediumDescription m = homogeneous(
      "3.0.0",
      "<rgb name='sigma_t' value='1 2 3'/><float name='albedo' value='0.5'/><float name='scale' "
      "value='4'/><boolean name='sample_emitters' value='false'/>");
  check_constant(m.sigma_t, 1, 2, 3);
  check_constant(m.albedo, 0.5, 0.5, 0.5);
  CHECK(m.scale == 4);
  check_constant(
      homogeneous("3.0.0",
                  "<volume name='sigma_t' type='constvolume'><rgb name='value' value='5 6 "
                  "7'/></volume>")
          .sigma_t,
      5, 6, 7);
  CHECK(read("3.0.0", "<medium type='homogeneous'><rgb name='albedo' value='1.5 0 0'/></medium>")
            .has("the reflectance 1.5 0 0 is greater than 1"));
}

TEST_CASE("homogeneous media of 0.x: pairs of coefficients, materials, three-valued spectra") {
  // Skin1, of which Mitsuba multiplies the published numbers by 100.
  check_constant(homogeneous("0.6.0", "").sigma_t, 77.2, 105, 149);
  const MediumDescription milk =
      homogeneous("0.6.0", "<string name='material' value='Lowfat MILK'/>");
  // Anisotropic materials have their reduced scattering coefficient.
  const double s = 1311.57 * (1 - 0.932), a = 0.287;
  CHECK(std::get<Spectrum>(milk.sigma_t).r == doctest::Approx(s + a).epsilon(1e-4));
  CHECK(std::get<Spectrum>(milk.albedo).r == doctest::Approx(s / (s + a)).epsilon(1e-4));
  const MediumDescription pair = homogeneous(
      "0.5.0",
      "<rgb name='sigmaS' value='1 2 0'/><spectrum name='sigmaA' value='1, 0, 0'/><float "
      "name='scale' value='10'/>");
  check_constant(pair.sigma_t, 2, 2, 0);
  check_constant(pair.albedo, 0.5, 1, 0);
  CHECK(pair.scale == 10);
  const MediumDescription other =
      homogeneous("0.5.0",
                  "<spectrum name='sigmaT' value='2'/><spectrum name='albedo' value='.5'/><float "
                  "name='densityMultiplier' value='3'/><spectrum name='g' value='.5'/>");
  check_constant(other.sigma_t, 1.5, 1.5, 1.5);
  check_constant(other.albedo, 1.0 / 3, 1.0 / 3, 1.0 / 3);
  CHECK(other.scale == 3);
  const auto fails = [](const std::string& content, const std::string& message) {
    const ReadResult r = read("0.6.0", "<medium type='homogeneous'>" + content + "</medium>");
    CHECK_MESSAGE(r.has(message), r.messages());
  };
  fails("<spectrum name='sigmaT' value='2'/><spectrum name='sigmaA' value='1'/>",
        "either \"sigmaS\" and \"sigmaA\" or");
  fails("<spectrum name='sigmaT' value='2'/><string name='material' value='ketchup'/>",
        "either a material or coefficients");
  fails("<string name='material' value='ketchap'/>", "did you mean \"ketchup\"");
  fails("<spectrum name='g' value='1'/>", "the anisotropy must be less than 1");
  fails("<spectrum name='sigmaA' value='-1'/>", "negative component");
}

TEST_CASE("a monochromatic medium of 0.x has one channel's coefficients in all") {
  const std::string coefficients =
                        "<rgb name='sigmaS' value='1 2 3'/><rgb name='sigmaA' value='5 1 2'/>",
                    single = "<string name='strategy' value='single'/>",
                    grey = "<boolean name='monochromatic' value='true'/>";
  const auto read_as = [&](const std::string& version, const std::string& more) {
    return homogeneous(version, coefficients + more);
  };
  for (const char* version : {"0.6.0", "3.0.0"}) {
    // The channel of the least extinction, or the one named.
    const MediumDescription least = read_as(version, single + grey);
    check_constant(least.sigma_t, 3, 3, 3);
    check_constant(least.albedo, 2 / 3.0, 2 / 3.0, 2 / 3.0);
    check_constant(read_as(version, single + grey + "<integer name='channel' value='2'/>").sigma_t,
                   5, 5, 5);
  }
  // As in Mitsuba, other strategies know nothing of it.
  for (const std::string& other : {grey, grey + "<string name='strategy' value='maximum'/>", single,
                                   single + "<boolean name='monochromatic' value='false'/>"})
    check_constant(read_as("0.6.0", other).sigma_t, 6, 3, 5);
  const MediumDescription preset = homogeneous("0.6.0", single + grey);
  check_constant(preset.sigma_t, 77.2, 77.2, 77.2);
  const auto fails = [](const std::string& content, const std::string& message) {
    const ReadResult r = read("0.6.0", "<medium type='homogeneous'>" + content + "</medium>");
    CHECK_MESSAGE(r.has(message), r.messages());
  };
  fails("<integer name='channel' value='3'/>", "a colour channel is 0, 1 or 2, not 3");
  fails("<string name='strategy' value='singel'/>", "did you mean \"single\"");
}

TEST_CASE("grids: where they lie and what they are called in both Mitsubas") {
  const SceneDescription old = scene_of(
      "0.6.0", "heterogeneous",
      "<string name='method' value='simpson'/><volume name='density' type='gridvolume'><string "
      "name='filename' value='smoke.vol'/></volume><volume name='albedo' type='constvolume'><float "
      "name='value' value='.9'/></volume>");
  const VolumeDescription& v = old.volumes.at(0);
  CHECK(std::get<VolumeId>(old.media.at(0).sigma_t) == VolumeId{0});
  check_constant(old.media[0].albedo, .9, .9, .9);
  CHECK(v.nodes == VolumeNodes::on_faces);
  CHECK(v.to_world == Matrix4::translate(-1, 0, 0) * Matrix4::scale(2, 2, 4));
  CHECK(v.grid->values == std::vector<float>{1, 2});
  const auto grid = [](const std::string& version, const std::string& content) {
    return scene_of(version, "heterogeneous",
                    "<float name='albedo' value='.5'/><volume name='sigma_t' "
                    "type='gridvolume'><string name='filename' value='smoke.vol'/>" +
                        content + "</volume>")
        .volumes.at(0);
  };
  CHECK(grid("3.0.0", "").to_world == Matrix4{});
  CHECK(grid("3.0.0", "").nodes == VolumeNodes::within);
  CHECK(grid("3.0.0", "<boolean name='use_grid_bbox' value='true'/>").to_world == v.to_world);
  const VolumeDescription placed =
      grid("3.0.0",
           "<transform name='to_world'><translate x='3'/></transform><boolean "
           "name='use_grid_bbox' value='true'/><string name='wrap_mode' value='mirror'/><string "
           "name='filter_type' value='nearest'/>");
  CHECK(placed.to_world == Matrix4::translate(3, 0, 0) * v.to_world);
  CHECK(placed.wrap == VolumeWrap::mirror);
  CHECK(placed.filter == VolumeFilter::nearest);
  CHECK(grid("0.6.0", "<point name='min' x='0' y='0' z='0'/><point name='max' x='2' y='3' z='4'/>")
            .to_world == Matrix4::scale(2, 3, 4));
  const auto fails = [](const std::string& content, const std::string& message) {
    const ReadResult r = read("3.0.0", "<medium type='heterogeneous'>" + content + "</medium>");
    CHECK_MESSAGE(r.has(message), r.messages());
  };
  const auto volume = [](const std::string& content) {
    return "<volume name='sigma_t' type='gridvolume'>" + content + "</volume>";
  };
  fails(volume(""), "needs the parameter \"filename\"");
  fails(volume("<string name='filename' value='none.vol'/>"), "not found");
  fails(volume("<string name='filename' value='broken.vol'/>"), "is of version 7");
  fails(
      volume("<string name='filename' value='smoke.vol'/><string name='wrap_mode' value='tile'/>"),
      "cannot be \"tile\"");
  fails("<volume name='sigma_t' type='hgridvolume'/>", "is refused");
  fails("<texture name='sigma_t' type='checkerboard'/>", "");
  CHECK(read("0.6.0", "<medium type='heterogeneous'/>").has("needs the parameter \"density\""));
}

// Mitsuba 3 has nothing outside of the unit cube of the volume, even if that is constant.
TEST_CASE("a constant extinction of a heterogeneous medium fills a box in Mitsuba 3") {
  const auto check = [](const SceneDescription& d, const std::vector<float>& values,
                        const Matrix4& to_world) {
    const VolumeDescription& v = d.volumes.at(size_t(std::get<VolumeId>(d.media.at(0).sigma_t)));
    CHECK(v.grid->values == values);
    CHECK(v.grid->node_count() == 1);
    CHECK(v.to_world == to_world);
  };
  const std::string scaled =
      "<volume name='sigma_t' type='constvolume'><rgb name='value' value='5 6 7'/><transform "
      "name='to_world'><scale value='3'/></transform></volume>";
  check(scene_of("3.0.0", "heterogeneous", ""), {1}, Matrix4{});
  check(scene_of("3.0.0", "heterogeneous", "<float name='sigma_t' value='2'/>"), {2}, Matrix4{});
  const SceneDescription placed = scene_of("3.0.0", "heterogeneous", scaled);
  check(placed, {5, 6, 7}, Matrix4::scale(3, 3, 3));
  const MitsubaXml xml = write_mitsuba_xml(placed);
  CHECK(xml.losses.empty());
  const ReadResult again = read_text(xml.text);
  REQUIRE_MESSAGE(again.scene, again.messages());
  CHECK(again.description().media == placed.media);
  CHECK(again.description().volumes == placed.volumes);
  CHECK(again.messages().find("to_world") == std::string::npos);
  CHECK(homogeneous("3.0.0", scaled).sigma_t == ColorVolume(Spectrum(5, 6, 7)));
  const std::string old = "<float name='density' value='2'/><float name='albedo' value='.5'/>";
  CHECK(scene_of("0.6.0", "heterogeneous", old).media.at(0).sigma_t == ColorVolume(Spectrum(2)));
}

TEST_CASE("phase functions") {
  const auto phase = [](const std::string& version, const std::string& content) {
    const SceneDescription d = scene_of(version, "homogeneous", content);
    return d.phases.at(size_t(d.media.at(0).phase)).model;
  };
  CHECK(std::holds_alternative<IsotropicPhase>(phase("3.0.0", "")));
  CHECK(std::get<HenyeyGreensteinPhase>(phase("3.0.0", "<phase type='hg'/>")).g == 0.8);
  CHECK(std::holds_alternative<RayleighPhase>(phase("0.6.0", "<phase type='rayleigh'/>")));
  CHECK(
      std::get<TabulatedPhase>(
          phase("3.0.0", "<phase type='tabphase'><string name='values' value='0.5, 1 2'/></phase>"))
          .values == std::vector<double>{0.5, 1, 2});
  CHECK(std::holds_alternative<VolumeId>(
      std::get<SggxPhase>(phase("3.0.0",
                                "<phase type='sggx'><volume name='S' type='gridvolume'><string "
                                "name='filename' value='flakes.vol'/></volume></phase>"))
          .matrix));
  CHECK(std::get<double>(std::get<BlendPhase>(phase("3.0.0",
                                                    "<phase type='blendphase'><float name='weight' "
                                                    "value='.2'/><phase type='hg'/><phase "
                                                    "type='isotropic'/></phase>"))
                             .weight) == doctest::Approx(.2));
  const SceneDescription mixture =
      scene_of("0.6.0", "homogeneous",
               "<phase type='mixturephase'><string name='weights' value='.2, .3, .5'/><phase "
               "type='hg'/><phase type='isotropic'/><phase type='rayleigh'/></phase>");
  const auto& outer =
      std::get<BlendPhase>(mixture.phases.at(size_t(mixture.media.at(0).phase)).model);
  CHECK(std::get<double>(outer.weight) == doctest::Approx(.8));
  const auto& inner = std::get<BlendPhase>(mixture.phases.at(size_t(outer.second)).model);
  CHECK(std::get<double>(inner.weight) == doctest::Approx(.5 / .8));
  CHECK(std::holds_alternative<RayleighPhase>(mixture.phases.at(size_t(inner.second)).model));
  const auto fails = [](const std::string& content, const std::string& message) {
    const ReadResult r = read("3.0.0", "<phase " + content + "</phase>");
    CHECK_MESSAGE(r.has(message), r.messages());
  };
  fails("type='hg'><float name='g' value='1'/>", "lies between -1 and 1");
  fails("type='tabphase'><string name='values' value='1'/>", "at least two values");
  fails("type='tabphase'><string name='values' value='0 0'/>", "not all zero");
  fails("type='tabphase'><string name='values' value='1 -1'/>", "negative");
  fails("type='tabphase'>", "needs the parameter \"values\"");
  fails("type='blendphase'><phase type='hg'/>", "needs 2 phase functions, not 1");
  fails("type='sggx'>", "needs the parameter \"S\"");
  const ReadResult fibre = read("0.6.0", "<phase type='kkay'/>");
  CHECK(fibre.scene);
  CHECK(fibre.has("warning"));
  CHECK(fibre.description().approximations.at(0).message ==
        "the phase function \"kkay\" is isotropic");
}

TEST_CASE("media on shapes, sensors and lights") {
  const std::string media =
      "<medium id='a' type='homogeneous'/><medium id='b' type='homogeneous'/>";
  const std::string both = "<ref name='interior' id='a'/><ref name='exterior' id='b'/>";
  ReadResult r = read("3.0.0", media + "<shape type='sphere'>" + both +
                                   "</shape><emitter type='point'><ref id='b'/></emitter>");
  REQUIRE_MESSAGE(r.scene, r.messages());
  const ShapeDescription& s = r.description().shapes.at(0);
  CHECK(s.interior == MediumId{0});
  CHECK(s.exterior == MediumId{1});
  CHECK(r.description().lights.at(0).medium == MediumId{1});
  // Without a BSDF: a surface in Mitsuba 3, none in 0.x unless it shines.
  const auto material = [&](const std::string& version, const std::string& more) {
    ReadResult read_again = read(version, media + "<shape type='sphere'>" + more + "</shape>");
    REQUIRE_MESSAGE(read_again.scene, read_again.messages());
    const SceneDescription& d = read_again.description();
    return d.materials.at(size_t(d.shapes.at(0).material)).model;
  };
  CHECK(material("3.0.0", both).is<DiffuseMaterial>());
  CHECK(material("0.6.0", both).is<NullMaterial>());
  CHECK(material("0.6.0", "").is<DiffuseMaterial>());
  CHECK(material("0.6.0", both + "<emitter type='area'/>").is<DiffuseMaterial>());
  CHECK(material("0.6.0", both + "<bsdf type='conductor'/>").is<ConductorMaterial>());
  CHECK(read("0.6.0", media + "<shape type='sphere'><ref name='inside' id='a'/></shape>")
            .has("is called \"interior\" or \"exterior\""));
  CHECK(read("3.0.0",
             media + "<shape type='sphere'>" + both + "<ref name='interior' id='b'/></shape>")
            .has("given twice"));
  const ReadResult sensor =
      read_text("<scene version='0.6.0'><integrator type='volpath_simple'/>" + media +
                "<sensor type='perspective'><ref id='b'/></sensor></scene>");
  REQUIRE_MESSAGE(sensor.scene, sensor.messages());
  CHECK(sensor.description().sensors.at(0).medium == MediumId{1});
  CHECK(std::get<VolumePathIntegratorDescription>(sensor.description().integrator.method) ==
        VolumePathIntegratorDescription{});
}

TEST_CASE("what Mitsuba 3 cannot read of media is said when they are written") {
  const SceneDescription d = scene_of("0.6.0", "heterogeneous",
                                      "<volume name='density' type='gridvolume'><string "
                                      "name='filename' value='bytes.vol'/></volume>"
                                      "<float name='albedo' value='.5'/>");
  const MitsubaXml xml = write_mitsuba_xml(d);
  CHECK(xml.losses.size() == 2);
  CHECK(xml.text.find("<medium type=\"heterogeneous\" id=\"m\">") != std::string::npos);
}
