// Numbers in this file are Mitsuba 3.9.1's (scalar_rgb): traverse() of a diffuse BSDF's
// reflectance, a conductor's eta, or a constant emitter's radiance, loaded from the same element.
#include "values/color.h"

#include <doctest/doctest.h>

#include "support/memory_scene.h"
#include "values/ior.h"

using namespace duet;
using namespace duet::test;

namespace {

void check_color(const Spectrum& a, double r, double g, double b, double tolerance = 2e-3) {
  CAPTURE(a.r);
  CAPTURE(a.g);
  CAPTURE(a.b);
  const double expected[3] = {r, g, b};
  for (int i = 0; i < 3; ++i)
    CHECK(double(a[i]) == doctest::Approx(expected[i]).epsilon(tolerance).scale(0.01));
}

Spectrum reflectance(const std::string& version, const std::string& element) {
  return std::get<Spectrum>(
      read_bsdf<DiffuseMaterial>(version, "<bsdf type='diffuse'>" + element + "</bsdf>")
          .reflectance);
}

Spectrum radiance(const std::string& version, const std::string& element) {
  const ReadResult r = read_scene(version, "<emitter type='constant'>" + element + "</emitter>");
  if (!r.scene) throw std::runtime_error(r.messages());
  return std::get<ConstantLight>(r.description().lights[0].model).radiance;
}

std::string spectrum(const std::string& name, const std::string& value) {
  return "<spectrum name='" + name + "' value='" + value + "'/>";
}

}  // namespace

TEST_CASE("rgb is linear, with one or three numbers") {
  for (const char* version : {"0.6.0", "3.0.0"}) {
    CHECK(reflectance(version, "<rgb name='reflectance' value='0.25'/>") == Spectrum(0.25f));
    CHECK(reflectance(version, "<rgb name='reflectance' value='.1,.2 .3'/>") ==
          Spectrum(0.1f, 0.2f, 0.3f));
    CHECK(reflectance(version, "<float name='reflectance' value='0.3'/>") == Spectrum(0.3f));
    CHECK(radiance(version, "<rgb name='radiance' value='17, 12, 4'/>") == Spectrum(17, 12, 4));
    CHECK(radiance(version, "<float name='radiance' value='2'/>") == Spectrum(2.0f));
    CHECK(radiance(version, "") == Spectrum(1.0f));
  }
}

TEST_CASE(
    "hexadecimal colours: not decoded as rgb in 0.x, decoded as srgb, refused as rgb in 3.x") {
  CHECK(reflectance("0.5.0", "<rgb name='reflectance' value='#ff8000'/>") ==
        Spectrum(1.0f, float(128 / 255.0), 0.0f));
  // 128/255 decoded by the sRGB curve: ((128/255 + 0.055) / 1.055)^2.4 = 0.21586
  check_color(reflectance("0.6.0", "<srgb name='reflectance' value='#FF8000'/>"), 1, 0.2158605, 0,
              1e-5);
  check_color(reflectance("3.0.0", "<srgb name='reflectance' value='#ff8000'/>"), 1, 0.2158605, 0,
              1e-5);
  check_color(reflectance("0.6.0", "<srgb name='reflectance' value='0.5'/>"), 0.2140411, 0.2140411,
              0.2140411, 1e-5);
  CHECK(read_scene("3.0.0", "<bsdf type='diffuse'><rgb name='reflectance' value='#ff8000'/></bsdf>")
            .has("scene.xml:2:46: error: <rgb> takes no hexadecimal numbers"));
}

TEST_CASE("a scalar spectrum is grey, except on a light of Mitsuba 3") {
  CHECK(reflectance("3.0.0", spectrum("reflectance", "0.5")) == Spectrum(0.5f));
  CHECK(reflectance("0.6.0", spectrum("reflectance", "0.5")) == Spectrum(0.5f));
  check_color(radiance("3.0.0", spectrum("radiance", "1")), 1.20479, 0.948291, 0.908916, 1e-5);
  check_color(radiance("2.0.0", spectrum("radiance", "70000")), 84335.6, 66380.4, 63624.1, 1e-5);
  CHECK(radiance("0.6.0", spectrum("radiance", "100")) == Spectrum(100.0f));
}

TEST_CASE("three numbers in a spectrum are linear RGB in 0.x only") {
  CHECK(radiance("0.5.0", spectrum("radiance", "1 2 3")) == Spectrum(1, 2, 3));
  CHECK(read_scene("3.0.0",
                   "<emitter type='constant'>" + spectrum("radiance", "1 2 3") + "</emitter>")
            .has("is not a spectrum"));
}

TEST_CASE("tabulated spectra are what Mitsuba 3 makes of them") {
  for (const char* version : {"0.6.0", "3.0.0"}) {
    check_color(
        reflectance(version, spectrum("reflectance", "400:0.78, 500:0.78, 600:0.78, 700:0.78")),
        0.776367, 0.77981, 0.776029, 1e-3);
    check_color(reflectance(version, spectrum("reflectance", "400:0.2 500:0.78, 600:0.3, 700:0.9")),
                0.29251, 0.597368, 0.508987, 1e-3);
    check_color(radiance(version, spectrum("radiance", "400:0, 500:8, 600:15.6, 700:18.4")),
                20.7108, 10.8546, 2.77115, 1e-3);
    check_color(radiance(version, spectrum("radiance", "300:1, 900:1")), 1.20488, 0.948228,
                0.909267, 1e-3);
  }
  // Narrow bands are out of gamut and clamped.
  check_color(reflectance("3.0.0", spectrum("reflectance", "560:0,570:1,580:0")), 0.0919813,
              0.0953796, 0);
  check_color(reflectance("3.0.0", spectrum("reflectance", "510:0,520:1,530:0")), 0, 0.125623, 0);
  check_color(radiance("3.0.0", spectrum("radiance", "510:0,520:1,530:0")), 0, 0.117586, 0);
  check_color(reflectance("3.0.0", spectrum("reflectance", "400:0.2 500:1.78, 600:0.3, 700:0.9")),
              0.0235965, 1, 1);
  check_color(reflectance("3.0.0", spectrum("reflectance", "400:-0.2 500:0.78, 600:0.3, 700:0.9")),
              0.281136, 0.612784, 0.302858);
}

TEST_CASE("narrow spectra are added up in the steps of Mitsuba 3") {
  const auto both = [](const char* value, double r, double g, double b, double light_g,
                       double light_b) {
    CAPTURE(value);
    check_color(reflectance("3.0.0", spectrum("reflectance", value)), r, g, b, 1e-5);
    check_color(radiance("3.0.0", spectrum("radiance", value)), 0, light_g, light_b, 1e-5);
  };
  both("500:0, 501:1, 502:0", 0, 0.0066223955, 0.0021194466, 0.006003712, 0.0019213823);
  both("540:1, 560:1", 0, 0.2817733, 0, 0.27039808, 0);
  both("500:0.9, 520:0.4", 0, 0.120033555, 0.011961989, 0.110593095, 0.010877395);
  check_color(radiance("3.0.0", spectrum("radiance", "360:1,830:1")), 1.2048837, 0.9482282,
              0.9092668, 1e-5);
  // Mitsuba 0.6 integrates.
  check_color(radiance("0.6.0", spectrum("radiance", "540:1, 560:1")), 0, 0.267528, 0, 1e-5);
}

TEST_CASE("spectra of indices of refraction are not limited to 1") {
  const auto m = read_bsdf<ConductorMaterial>(
      "3.0.0", "<bsdf type='conductor'>" + spectrum("eta", "400:0.2 500:1.78, 600:0.3, 700:0.9") +
                   spectrum("k", "3") + "</bsdf>");
  check_color(std::get<Spectrum>(m.eta), 0.0235965, 1.22878, 1.05776);
  CHECK(std::get<Spectrum>(m.k) == Spectrum(3.0f));
}

TEST_CASE("spectra come from files as well") {
  MemoryFiles files;
  files.texts["/scene/lamp.spd"] = "# a lamp\n400 0\n500 8 # and so on\n600 15.6\n\n700 18.4\n";
  const ReadResult r = read_scene(
      "3.0.0", "<emitter type='constant'><spectrum name='radiance' filename='lamp.spd'/></emitter>",
      files);
  REQUIRE(r.scene);
  check_color(std::get<ConstantLight>(r.description().lights[0].model).radiance, 20.7108, 10.8546,
              2.77115, 1e-3);
}

TEST_CASE("black bodies") {
  // Planck's law in W/(m² sr nm), integrated against the colour matching functions with
  // mi.load_dict({'type': 'blackbody'}) in scalar_spectral and mi.cie1931_xyz in steps of 0.5 nm.
  check_color(radiance("0.6.0", "<blackbody name='radiance' temperature='3000K'/>"), 733.845,
              349.918, 112.822);
  check_color(radiance("0.6.0", "<blackbody name='radiance' temperature='6500' scale='2'/>"),
              87925.2, 82897.3, 87252.7);
  check_color(radiance("3.0.0",
                       "<spectrum name='radiance' type='blackbody'><float name='temperature' "
                       "value='2000'/></spectrum>"),
              16.0303, 4.11596, 0.130516);
}

TEST_CASE("spectrum plugins of Mitsuba 3") {
  const auto light = [](const std::string& type, const std::string& content) {
    return radiance("3.0.0",
                    "<spectrum name='radiance' type='" + type + "'>" + content + "</spectrum>");
  };
  CHECK(light("d65", "<float name='scale' value='2'/>") == Spectrum(2.0f));
  CHECK(light("d65", "<rgb name='color' value='1 .5 .2'/>") == Spectrum(1, 0.5f, 0.2f));
  CHECK(light("uniform", "<float name='value' value='2'/>") == Spectrum(2.0f));
  CHECK(light("rawconstant", "<vector name='value' value='2 3 4'/>") == Spectrum(2, 3, 4));
  CHECK(
      light("srgb", "<rgb name='color' value='2 3 4'/><boolean name='unbounded' value='true'/>") ==
      Spectrum(2, 3, 4));
  check_color(light("irregular",
                    "<string name='wavelengths' value='400,500,600,700'/><string name='values' "
                    "value='0, 8, 15.6, 18.4'/>"),
              20.7108, 10.8546, 2.77115, 1e-3);
  check_color(light("regular",
                    "<float name='wavelength_min' value='400'/><float name='wavelength_max' "
                    "value='700'/><string name='values' value='0 8 15.6 18.4'/>"),
              20.7108, 10.8546, 2.77115, 1e-3);
  CHECK(reflectance("3.0.0",
                    "<texture name='reflectance' type='uniform'><float name='value' "
                    "value='0.2'/></texture>") == Spectrum(0.2f));
}

TEST_CASE("reflectances above one") {
  const auto messages = [](const std::string& version, const std::string& element) {
    return read_scene(version,
                      "<shape type='sphere'><bsdf type='diffuse'>" + element + "</bsdf></shape>")
        .messages();
  };
  // Mitsuba 3: "Invalid RGB reflectance value [1.5, 1.5, 1.5], must be in the range [0, 1]!"
  CHECK(messages("3.0.0", "<rgb name='reflectance' value='1.5'/>").find("greater than 1") !=
        std::string::npos);
  CHECK(reflectance("3.0.0", spectrum("reflectance", "1.5")) == Spectrum(1.5f));
  // Mitsuba 0.6 scales the largest component to 0.99.
  const Spectrum scaled = reflectance("0.6.0", "<rgb name='reflectance' value='2 1 0'/>");
  check_color(scaled, 0.99, 0.495, 0, 1e-6);
  CHECK(reflectance("0.6.0",
                    "<rgb name='reflectance' value='2 1 0'/>"
                    "<boolean name='ensureEnergyConservation' value='false'/>") ==
        Spectrum(2, 1, 0));
  CHECK(messages("3.0.0", "<rgb name='reflectance' value='-0.1'/>").find("negative") !=
        std::string::npos);
}

TEST_CASE("metals by name") {
  const auto metal = [](const std::string& version, const std::string& content) {
    return read_bsdf<ConductorMaterial>(version, "<bsdf type='conductor'>" + content + "</bsdf>");
  };
  const ConductorMaterial cu = metal("3.0.0", "<string name='material' value='Cu'/>");
  check_color(std::get<Spectrum>(cu.eta), 0.201005, 0.92375, 1.10222, 1e-5);
  check_color(std::get<Spectrum>(cu.k), 3.91326, 2.45305, 2.14209, 1e-5);
  // A perfect mirror in 3.x, copper in 0.x, where the index of air divides.
  CHECK(std::get<Spectrum>(metal("3.0.0", "").eta) == Spectrum(0.0f));
  CHECK(std::get<Spectrum>(metal("3.0.0", "").k) == Spectrum(1.0f));
  check_color(std::get<Spectrum>(metal("0.6.0", "").eta), 0.201005 / 1.000277, 0.92375 / 1.000277,
              1.10222 / 1.000277, 1e-5);
  CHECK(metal("0.6.0", "<string name='material' value='none'/>") == metal("3.0.0", ""));
  check_color(std::get<Spectrum>(metal("0.6.0",
                                       "<rgb name='eta' value='3'/><rgb name='k' value='6'/>"
                                       "<string name='extEta' value='water'/>")
                                     .k),
              6 / 1.333, 6 / 1.333, 6 / 1.333, 1e-6);
  CHECK(conductors().size() == 71);
  CHECK(find_conductor("Al"));
  CHECK(!find_conductor("al"));
}

TEST_CASE("indices of refraction by name and number") {
  const auto eta = [](const std::string& content) {
    return std::get<double>(
        read_bsdf<DielectricMaterial>("3.0.0", "<bsdf type='dielectric'>" + content + "</bsdf>")
            .eta);
  };
  CHECK(eta("") == doctest::Approx(1.504183292388916).epsilon(1e-6));
  CHECK(eta("<string name='int_ior' value='Water'/>") ==
        doctest::Approx(1.3326307535171509).epsilon(1e-6));
  CHECK(eta("<float name='int_ior' value='1.5'/><float name='ext_ior' value='1'/>") == 1.5);
  CHECK(eta("<integer name='intIOR' value='2'/><string name='extIOR' value='vacuum'/>") == 2);
  CHECK(find_dielectric("diamond") == 2.419);
}
