// What the parameters of fibres, measurements, filters, coats, layers and of shapes that are many
// become.
#include <doctest/doctest.h>

#include <cmath>

#include "parsers/plugin_checks.h"
#include "support/source_path.h"

using namespace duet;
using namespace duet::test;

namespace {

std::string scene_file(const std::string& name) {
  return "<string name='filename' value='" + source_path("scenes/") + name + "'/>";
}

/// A scene with files on the disk.
ReadResult on_disk(const std::string& version, const std::string& content) {
  MemoryFiles files = image();
  for (const char* name : {"curves/cables.txt", "curves/ellipsoids.ply", "bsdf-fibres/fur.txt",
                           "bsdf-measured/isotropic.bsdf"})
    files.texts[source_path("scenes/") + name] = "x";
  return read_scene(version, content, files);
}

const ShapeDescription& first_shape(const ReadResult& r) {
  return r.description().shapes.at(0);
}

}  // namespace

TEST_CASE("bsdf: hair") {
  HairMaterial expected;
  CHECK(std::get<double>(bsdf<HairMaterial>("3.0.0", "hair").eta) ==
        doctest::Approx(std::get<double>(expected.eta)));
  const auto m = bsdf<HairMaterial>(
      "3.0.0", "hair",
      "<float name='longitudinal_roughness' value='0.1'/><float name='azimuthal_roughness' "
      "value='0.2'/><float name='scale_tilt' value='3'/><float name='eumelanin' value='0.4'/>"
      "<float name='int_ior' value='1.5'/><float name='ext_ior' value='1'/>");
  CHECK(m.longitudinal_roughness == FloatInput(0.1));
  CHECK(m.azimuthal_roughness == FloatInput(0.2));
  CHECK(m.scale_tilt == FloatInput(3.0));
  CHECK(m.eumelanin == FloatInput(0.4));
  CHECK(m.pheomelanin == FloatInput(0.2));
  CHECK(m.eta == FloatInput(1.5));
  CHECK_FALSE(m.sigma_a);
  const auto dyed = bsdf<HairMaterial>(
      "3.0.0", "hair", "<rgb name='sigma_a' value='1, 2, 3'/><float name='scale' value='5'/>");
  CHECK(*dyed.sigma_a == ColorInput(Spectrum(1, 2, 3)));
  CHECK(dyed.scale == 5);
  CHECK(fails("3.0.0",
              "<bsdf type='hair'><rgb name='sigma_a' value='1, 2, 3'/>"
              "<float name='eumelanin' value='1'/></bsdf>",
              "either \"sigma_a\" or concentrations"));
  CHECK(fails("3.0.0",
              "<bsdf type='hair'><rgb name='reflectance' value='.1, .2, .3'/>"
              "<rgb name='sigma_a' value='1, 2, 3'/></bsdf>",
              "either \"sigma_a\" or \"reflectance\""));
  CHECK(fails("3.0.0", "<bsdf type='hair'><float name='longitudinal_roughness' value='2'/></bsdf>",
              "longitudinal_roughness"));
}

TEST_CASE("bsdf: pplastic") {
  const auto m = bsdf<PolarizedPlasticMaterial>(
      "3.0.0", "pplastic",
      "<float name='alpha_u' value='0.3'/><float name='alpha_v' value='0.2'/>"
      "<float name='int_ior' value='1.8'/><float name='ext_ior' value='1'/>");
  CHECK(m.eta == 1.8);
  CHECK(m.interface.alpha_u == FloatInput(0.3));
  CHECK(m.interface.alpha_v == FloatInput(0.2));
  CHECK(m.diffuse_reflectance == ColorInput(Spectrum(0.5f)));
}

TEST_CASE("bsdf: polarizer, retarder and circular say what they are without polarisation") {
  for (const auto& [name, kind] : {std::pair{"polarizer", FilterKindOfLight::polarizer},
                                   {"retarder", FilterKindOfLight::retarder},
                                   {"circular", FilterKindOfLight::circular}}) {
    const ReadResult r = on_disk("3.0.0", std::string("<bsdf type='") + name +
                                              "'><rgb name='transmittance' value='1 0.5 0'/>"
                                              "<float name='theta' value='30'/></bsdf>");
    REQUIRE(r.scene);
    CHECK(r.has("without polarisation"));
    const auto& m = r.description().materials.at(0).model.get<FilterMaterial>();
    CHECK(m.kind == kind);
    CHECK(m.transmittance == ColorInput(Spectrum(1, 0.5f, 0)));
  }
}

TEST_CASE("bsdf: measured") {
  const ReadResult r = on_disk(
      "3.0.0", "<bsdf type='measured'>" + scene_file("bsdf-measured/isotropic.bsdf") + "</bsdf>");
  INFO(r.messages());
  REQUIRE(r.scene);
  const auto& m = r.description().materials.at(0).model.get<MeasuredMaterial>();
  CHECK(m.table->theta.size() == 5);
  CHECK(on_disk("3.0.0", "<bsdf type='measured'>" + scene_file("curves/cables.txt") + "</bsdf>")
            .has("is not a measured material"));
}

TEST_CASE("bsdf: coatings of 0.6") {
  const auto smooth = bsdf<CoatingMaterial>(
      "0.6.0", "coating",
      "<float name='intIOR' value='1.7'/><float name='extIOR' value='1'/><float name='thickness' "
      "value='2'/><spectrum name='sigmaA' value='0.5'/><bsdf type='diffuse'/>");
  CHECK(smooth.eta == 1.7);
  CHECK(smooth.thickness == 2);
  CHECK(smooth.sigma_a == ColorInput(Spectrum(0.5f)));
  CHECK_FALSE(smooth.roughness);
  const auto rough = bsdf<CoatingMaterial>(
      "0.6.0", "roughcoating", "<float name='alpha' value='0.2'/><bsdf type='diffuse'/>");
  REQUIRE(rough.roughness);
  CHECK(rough.roughness->alpha_u == FloatInput(0.2));
  CHECK(fails("0.6.0", "<bsdf type='coating'/>", "needs one nested BSDF, not 0"));
  CHECK(fails("0.6.0",
              "<bsdf type='twosided'><bsdf type='coating'><bsdf type='dielectric'/></bsdf></bsdf>",
              "cannot hold a BSDF that lets light through"));
}

TEST_CASE("bsdf: hk and sssbrdf") {
  const auto m = bsdf<ThinLayerMaterial>(
      "0.6.0", "hk",
      "<spectrum name='sigmaS' value='2'/><spectrum name='sigmaA' value='1'/><float "
      "name='thickness' value='0.1'/><phase type='hg'><float name='g' value='0.3'/></phase>");
  CHECK(m.sigma_s == ColorInput(Spectrum(2)));
  CHECK(m.sigma_a == ColorInput(Spectrum(1)));
  CHECK(m.thickness == 0.1);
  CHECK(m.g == 0.3);
  const auto other = bsdf<ThinLayerMaterial>(
      "0.6.0", "hk", "<spectrum name='sigmaT' value='4'/><spectrum name='albedo' value='0.75'/>");
  CHECK(other.sigma_s == ColorInput(Spectrum(3)));
  CHECK(other.sigma_a == ColorInput(Spectrum(1)));
  const ReadResult sss =
      on_disk("0.6.0",
              "<bsdf type='sssbrdf'><spectrum name='sigmaS' value='1'/><spectrum name='sigmaA' "
              "value='0'/></bsdf>");
  REQUIRE(sss.scene);
  CHECK(sss.has("dipole"));
  // Nothing is absorbed: the base is white.
  const auto& white = sss.description().materials.at(0).model.get<PlasticMaterial>();
  CHECK(std::get<Spectrum>(white.diffuse_reflectance).r > 0.95f);
}

TEST_CASE("what cannot be is refused with a reason") {
  CHECK(fails("3.0.0", "<bsdf type='measured_polarized'/>", "no polarisation"));
  CHECK(fails("0.6.0", "<shape type='sphere'><subsurface type='dipole'/></shape>", "volpath"));
  CHECK(fails("3.0.0",
              "<bsdf type='twosided'><boolean name='allow_transmission' value='true'/>"
              "<bsdf type='dielectric'/></bsdf>",
              "\"allow_transmission\" is not supported"));
}

TEST_CASE("shape: curves") {
  for (const auto& [name, kind] :
       {std::pair{"linearcurve", CurveKind::linear}, {"bsplinecurve", CurveKind::bspline}}) {
    const ReadResult r = on_disk(
        "3.0.0", std::string("<shape type='") + name + "'>" + scene_file("curves/cables.txt") +
                     "<transform name='to_world'><scale value='2'/></transform></shape>");
    INFO(r.messages());
    REQUIRE(r.scene);
    const auto& curves = *std::get<CurvesShape>(first_shape(r).geometry).curves;
    CHECK(curves.kind == kind);
    CHECK(curves.points.size() == 27);
    CHECK(curves.segments.size() == (kind == CurveKind::linear ? 24 : 18));
    CHECK(first_shape(r).to_world == Matrix4::scale(2, 2, 2));
    CHECK(on_disk("3.0.0", std::string("<shape type='") + name + "'>" +
                               scene_file("curves/cables.txt") + "<emitter type='area'/></shape>")
              .has("cannot emit light"));
  }
  CHECK(on_disk("3.0.0",
                "<shape type='linearcurve'>" + scene_file("curves/ellipsoids.ply") + "</shape>")
            .has("ellipsoids.ply:1: \"ply\" is not a number (x)"));
}

TEST_CASE("shape: hair of 0.6") {
  const ReadResult r = on_disk("0.6.0", "<shape type='hair'>" + scene_file("bsdf-fibres/fur.txt") +
                                            "<float name='radius' value='0.25'/></shape>");
  INFO(r.messages());
  REQUIRE(r.scene);
  const auto& curves = *std::get<CurvesShape>(first_shape(r).geometry).curves;
  CHECK(curves.points.at(0).radius == 0.25f);
  CHECK_FALSE(curves.outside_only);
}

TEST_CASE("shape: ellipsoids and merge") {
  const ReadResult r = on_disk(
      "3.0.0", "<shape type='merge'><shape type='sphere'/><shape type='ellipsoids'>" +
                   scene_file("curves/ellipsoids.ply") +
                   "<float name='extent' value='2'/><transform name='to_world'><rotate z='1' "
                   "angle='90'/><scale value='3'/></transform></shape></shape>");
  INFO(r.messages());
  REQUIRE(r.scene);
  const auto& shapes = r.description().shapes;
  REQUIRE(shapes.size() == 5);
  // The third ellipsoid is a ball at (0.3, −1, 0.25) with a radius of exp(−2.6).
  const Matrix4& m = shapes[3].to_world;
  const double radius = std::exp(-2.6) * 2 * 3;
  check_matrix(m, {0, -radius, 0, 3, radius, 0, 0, 0.9, 0, 0, radius, 0.75, 0, 0, 0, 1}, 1e-5);
  // All of them are stretched as the file says.
  CHECK(shapes[1].to_world.determinant3() ==
        doctest::Approx(std::exp(-3.0 - 2.2 - 2.5) * 216).epsilon(1e-4));
  CHECK(on_disk("3.0.0", "<shape type='ellipsoids'>" + scene_file("curves/cables.txt") + "</shape>")
            .has("cables.txt"));
}
