// Cameras of real lenses, films with layers and other things before WorldBegin in pbrt files.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "mitsuba/writer.h"
#include "support/pbrt_file.h"
#include "support/transport_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

const std::string kLens =
    "# radius thickness index diameter\n50 4 1.5 24\n-50 2 1 24\n0 40 0 16 # the stop\n";

/// A scene with a realistic camera of these parameters beside a lens file.
PbrtFile realistic(const std::string& lens, const std::string& parameters,
                   const std::string& more = "", bool v3 = false) {
  const TemporaryDirectory folder;
  folder.write("lens.dat", lens);
  const std::string file = folder.write(
      "scene.pbrt", "Camera \"realistic\" \"string lensfile\" \"lens.dat\" " + parameters + "\n" +
                        more + (v3 ? "Film \"image\"" : "Film \"rgb\" \"float diagonal\" 20") +
                        " \"integer xresolution\" 24 \"integer yresolution\" 16\n"
                        "PixelFilter \"box\"\nWorldBegin\n"
                        "LightSource \"infinite\" \"rgb L\" [2 2 2]\n" +
                        (v3 ? "WorldEnd\n" : ""));
  return read_pbrt_file(file);
}

void check_message(const PbrtFile& f, const std::string& message, bool has_scene = false) {
  CHECK(f.scene.has_value() == has_scene);
  CHECK_MESSAGE(f.messages.find(message) != f.messages.npos, f.messages, " lacks ", message);
}

}  // namespace

TEST_CASE("pbrt's realistic camera: lens files and parameters") {
  const PbrtFile f = realistic(kLens, "\"float aperturediameter\" 8 \"float focusdistance\" 3");
  REQUIRE_MESSAGE(f.scene, f.messages);
  CHECK(f.messages.empty());
  const SensorDescription& s = f.scene->sensors.at(0);
  CHECK(s.kind == SensorKind::realistic);
  REQUIRE(s.lenses.surfaces.size() == 3);
  CHECK(s.lenses.surfaces[0] == LensSurface{0.05, 0.004, 1.5, 0.012});
  CHECK(s.lenses.surfaces[2].ior == 1);
  CHECK(s.lenses.surfaces[2].aperture == doctest::Approx(0.004));
  CHECK(s.lenses.focus_distance == 3);
  CHECK(s.lenses.film_diagonal == doctest::Approx(0.02));
  CHECK_FALSE(s.lenses.relative_to_pupil);
  // Defaults: 1 mm, 10 m.
  const PbrtFile standard = realistic(kLens, "");
  CHECK(standard.scene->sensors.at(0).lenses.surfaces[2].aperture == doctest::Approx(0.0005));
  CHECK(standard.scene->sensors.at(0).lenses.focus_distance == 10);
  CHECK_FALSE(*standard.scene == *f.scene);
  const PbrtFile star = realistic(kLens, "\"string aperture\" \"star\"");
  CHECK(star.scene->sensors.at(0).lenses.stop == StopShape::star);
  // v3 is relative to the pupil unless it is told otherwise; then the shutter's time counts.
  CHECK(realistic(kLens, "", "", true).scene->sensors.at(0).lenses.relative_to_pupil);
  const PbrtFile v3 =
      realistic(kLens, "\"bool simpleweighting\" \"false\" \"float shutterclose\" .5", "", true);
  CHECK_FALSE(v3.scene->sensors.at(0).lenses.relative_to_pupil);
  REQUIRE(v3.scene->sensors.at(0).film.response);
  CHECK((*v3.scene->sensors.at(0).film.response)[1][1] == 0.5);
}

TEST_CASE("pbrt's realistic camera: what is wrong with a lens file is said with its place") {
  check_message(realistic(kLens + "7 8\n", ""),
                "lens.dat:6:1: error: a lens file has four numbers");
  check_message(realistic("# nothing\n", ""), "not 0 in all");
  check_message(realistic("50 4 nan 24\n", ""), "lens.dat:1:6: error: a lens file holds nothing");
  check_message(realistic("50 4 1e999 24\n", ""), "lens.dat:1:6: error:");
  check_message(realistic("50 4 1.5 24\n-50 2 1 0\n", ""), "surface 2 has the diameter 0");
  check_message(realistic("50 4 -1.5 24\n-50 2 1 3\n", ""), "surface 1 has the refractive index");
  check_message(realistic("50 4 1.5 24\n", ""), "there must be air behind the last surface");
  check_message(realistic("50 4 1.5 24\n-50 2 1 24\n", ""),
                "scene.pbrt:1:20: warning: the lens file has no stop", true);
  check_message(realistic(kLens, "\"float aperturediameter\" 20"),
                "the lens's stop opens to 16 mm at most, not 20", true);
  check_message(realistic(kLens, "\"float aperturediameter\" -1"), "scene.pbrt:1:49: error:");
  check_message(realistic(kLens, "\"string aperture\" \"hexagon.png\""), "hexagon.png");
  const TemporaryDirectory folder;
  for (const char* parameters : {"\"string lensfile\" \"none.dat\"", ""}) {
    Diagnostics diagnostics;
    CHECK_FALSE(
        pbrt::read_pbrt(folder.write("a.pbrt", std::string("Camera \"realistic\" ") + parameters +
                                                   "\nFilm \"rgb\"\nWorldBegin\n"),
                        {}, diagnostics));
    REQUIRE(diagnostics.has_errors());
    CHECK(diagnostics.all()[0].where.line == 1);
  }
}

TEST_CASE("pbrt's realistic camera: lenses that cannot be focused") {
  const auto build = [](const PbrtFile& f) {
    REQUIRE(f.scene);
    Diagnostics diagnostics;
    CHECK_FALSE(build_scene(*f.scene, {}, diagnostics));
    REQUIRE(diagnostics.has_errors());
    return diagnostics.all()[0].to_string();
  };
  CHECK(build(realistic(kLens, "\"float focusdistance\" .1"))
            .find("scene.pbrt:1:1: error: these lenses cannot be focused 0.1 before the film") !=
        std::string::npos);
}

TEST_CASE("realistic cameras are rendered by the methods that send rays from the camera") {
  const std::string open = "\"float aperturediameter\" 8 \"float focusdistance\" 3";
  const TransportScene scene(*realistic(kLens, open).scene);
  // In even light the image is the irradiance of the pupil: the same by all methods.
  const Image expected = scene.render("path", {}, 256, 1).image;
  const auto mean = [](const Image& image) {
    double sum = 0;
    for (size_t i = 0; i < image.data.size(); i += 4) sum += double(image.data[i]);
    return sum / double(image.data.size() / 4);
  };
  CHECK(mean(expected) > 0.03);
  for (const char* method : {"volpath", "bdpt", "vcm"}) {
    CAPTURE(method);
    CHECK(mean(scene.render(method, {}, 64, 2).image) ==
          doctest::Approx(mean(expected)).epsilon(0.02));
  }
  // The corners are darker by cos⁴ at least: 10 mm aside, some 52 mm away.
  const float corner = expected.data[0], centre = expected.data[4 * size_t(8 * 24 + 12)];
  CHECK(corner < centre * std::pow(std::cos(std::atan(9.5 / 52)), 4) * 1.05);
  CHECK(corner > 0.5f * centre);
  Diagnostics diagnostics;
  IntegratorDescription ptracer;
  apply_override(ptracer, {"ptracer", {}, {}});
  check_support(realistic(kLens, open).scene->sensors.at(0), ptracer, diagnostics);
  REQUIRE(diagnostics.has_errors());
  CHECK(diagnostics.all()[0].message.find("needs a sensor") != std::string::npos);
}

namespace {

PbrtFile gbuffer(const std::string& parameters, const std::string& look = "0 0 -5 0 0 0 0 1 0") {
  const TemporaryDirectory folder;
  return read_pbrt_file(folder.write(
      "scene.pbrt",
      "LookAt " + look +
          "\nCamera \"perspective\"\nFilm \"gbuffer\" \"integer "
          "xresolution\" 8 \"integer yresolution\" 8 " +
          parameters +
          "\nPixelFilter \"box\"\nWorldBegin\nLightSource \"infinite\"\n"
          "LightSource \"point\" \"point3 from\" [1 0 -2] \"rgb I\" [9 9 9]\n"
          "Material \"diffuse\" \"rgb reflectance\" [.2 .4 .6]\n"
          // z = 1 + x/2
          "Shape \"bilinearmesh\" \"point3 P\" [-9 -9 -3.5  9 -9 5.5  -9 9 -3.5  9 9 5.5]\n"));
}

/// A pixel of the image of a gbuffer, by the names of its channels.
std::map<std::string, double> gbuffer_pixel(const std::string& parameters, int spp,
                                            const std::string& look = "0 0 -5 0 0 0 0 1 0") {
  PbrtFile f = gbuffer(parameters, look);
  REQUIRE(f.scene);
  CHECK(f.scene->approximations.empty());
  f.scene->integrator.aovs.layers.push_back({"variance", "v"});
  const auto response = f.scene->sensors.at(0).film.response;
  TransportScene scene(*std::move(f.scene));
  scene.layout.response = response;
  const auto integrator = scene.method("path", {});
  const std::vector<std::string> names = integrator->channels();
  const Image image = scene.render(*integrator, scene.layout, spp, 1).image;
  std::map<std::string, double> pixel;
  // On the right of the middle, and above it.
  for (size_t c = 0; c < names.size(); ++c)
    pixel[names[c]] = double(image.data[c + (3 * 8 + 4) * names.size()]);
  return pixel;
}

}  // namespace

TEST_CASE("pbrt's gbuffer: its layers are in the image, in the coordinates that it asks for") {
  check_message(gbuffer("\"string coordinatesystem\" \"render\""), "camera or world");
  auto world = gbuffer_pixel("\"string coordinatesystem\" \"world\"", 1024);
  CHECK(world.at("Albedo.G") == doctest::Approx(0.4));
  const double x = world.at("P.X"), z = world.at("P.Z");
  CHECK(std::abs(x) > 0.1);
  CHECK(z == doctest::Approx(1 + x / 2).epsilon(1e-4));
  CHECK(world.at("N.Z") == doctest::Approx(-2 / std::sqrt(5.0)));
  CHECK(world.at("Ns.Z") == doctest::Approx(world.at("N.Z")));
  CHECK(world.at("uv.U") == doctest::Approx((x + 9) / 18).epsilon(1e-3));
  // A pixel is tan 45° / 4 wide at distance 1 along the axis. With x = ± s d and z = d − 5 the
  // plane is at d = 6 / (1 ∓ s / 2).
  const double pixel = 0.25, side = x > 0 ? 1 : -1, s = pixel / 2;
  const auto depth = [&](double across) { return 6 / (1 - side * across / 2); };
  const double step = (depth(s + 1.5 * pixel) - depth(s - 0.5 * pixel)) / 2;
  CHECK(world.at("dzdx.Z") == doctest::Approx(step).epsilon(0.05));
  CHECK(world.at("dzdy.Z") == doctest::Approx(0).scale(1));
  // The camera's space has the same z here, from the camera on, and x to the right of the image.
  auto camera = gbuffer_pixel("", 1024);
  CHECK(camera.at("P.X") == doctest::Approx(side * x).epsilon(1e-3));
  CHECK(camera.at("P.Z") == doctest::Approx(z + 5).epsilon(1e-3));
  CHECK(camera.at("N.Z") == doctest::Approx(world.at("N.Z")));
  CHECK(camera.at("dzdx.Z") == doctest::Approx(step).epsilon(0.05));
}

// A camera that is turned by 90° about y, looking along +x at the plane's other side.
TEST_CASE("pbrt's gbuffer: positions and normals turn with the camera, normals towards it") {
  const std::string look = "-20 0 1 0 0 1 0 1 0";
  auto world = gbuffer_pixel("\"string coordinatesystem\" \"world\"", 64, look),
       camera = gbuffer_pixel("", 64, look);
  REQUIRE(std::abs(world.at("P.Z") - 1) > 0.1);
  CHECK(world.at("N.X") == doctest::Approx(-1 / std::sqrt(5.0)));
  CHECK(world.at("N.Z") == doctest::Approx(2 / std::sqrt(5.0)));
  // Forward is the world's x, up its y, and to the right its -z.
  CHECK(camera.at("N.Z") == doctest::Approx(world.at("N.X")));
  CHECK(camera.at("N.X") == doctest::Approx(-world.at("N.Z")));
  CHECK(camera.at("P.Z") == doctest::Approx(world.at("P.X") + 20).epsilon(1e-4));
  CHECK(camera.at("P.X") == doctest::Approx(1 - world.at("P.Z")).epsilon(1e-4));
  CHECK(camera.at("P.Y") == doctest::Approx(world.at("P.Y")).epsilon(1e-4));
  // Layers that are asked for beside them are the world's.
  PbrtFile f = gbuffer("", look);
  f.scene->integrator.aovs.layers.push_back({"position", "mine"});
  TransportScene scene(*std::move(f.scene));
  const auto integrator = scene.method("path", {});
  const std::vector<std::string> names = integrator->channels();
  const Image image = scene.render(*integrator, scene.layout, 64, 1).image;
  const size_t x = size_t(std::find(names.begin(), names.end(), "mine.X") - names.begin());
  REQUIRE(x < names.size());
  CHECK(double(image.data[(3 * 8 + 4) * names.size() + x]) ==
        doctest::Approx(world.at("P.X")).epsilon(1e-4));
}

TEST_CASE("pbrt's gbuffer: a Mitsuba file has those layers that Mitsuba knows") {
  const MitsubaXml xml = write_mitsuba_xml(*gbuffer("").scene);
  for (const char* name : {"dzdx", "dzdy", "Variance", "RelativeVariance"})
    CHECK(std::count(xml.losses.begin(), xml.losses.end(),
                     std::string("the layer \"") + name + "\" is missing") == 1);
  CHECK(xml.text.find("\"Albedo:albedo, P:position, uv:uv, N:geo_normal, Ns:sh_normal\"") !=
        std::string::npos);
}

TEST_CASE("pbrt's gbuffer: variances are those of samples, after the exposure") {
  constexpr int kSpp = 64;
  auto plain = gbuffer_pixel("", kSpp), bright = gbuffer_pixel("\"float iso\" 200", kSpp);
  const double variance = plain.at("Variance.G");
  CHECK(variance > 1e-5);
  CHECK(plain.at("v.G") * kSpp * kSpp / (kSpp - 1) == doctest::Approx(variance).epsilon(1e-4));
  CHECK(plain.at("RelativeVariance.G") == doctest::Approx(variance / plain.at("G")).epsilon(1e-4));
  CHECK(bright.at("G") == doctest::Approx(2 * plain.at("G")).epsilon(1e-4));
  CHECK(bright.at("Variance.G") == doctest::Approx(4 * variance).epsilon(1e-4));
  CHECK(bright.at("RelativeVariance.G") ==
        doctest::Approx(2 * plain.at("RelativeVariance.G")).epsilon(1e-4));
}

TEST_CASE("pbrt: what colours cannot say of spectra is listed as approximated") {
  const auto approximated = [](const std::string& world, const std::string& film = "") {
    const TemporaryDirectory folder;
    Diagnostics diagnostics;
    const auto read = pbrt::read_pbrt(
        folder.write("scene.pbrt", "Film \"rgb\" " + film + "\nWorldBegin\n" + world), {},
        diagnostics);
    REQUIRE(read);
    std::string all;
    for (const Diagnostic& d : read->description.approximations) all += d.message + "\n";
    return all;
  };
  const std::string light = "LightSource \"point\" \"spectrum I\" ";
  CHECK(approximated(light + "[500 0 520 1 540 0]\n") ==
        "the narrow spectrum \"I\" by its colour\n");
  CHECK(approximated(light + "[400 0 401 1 402 0 600 0 601 1 602 0]\n").size() > 0);
  CHECK(approximated(light + "[400 1 600 1]\n").empty());
  CHECK(approximated(light + "[380 .5 500 1 600 .7 780 .2]\n").empty());
  CHECK(approximated(light + "\"stdillum-F11\"\n") ==
        "the narrow bands of stdillum-F11 by their colour\n");
  CHECK(approximated(light + "\"stdillum-D50\"\n").empty());
  CHECK(approximated("Material \"dielectric\" \"spectrum eta\" \"glass-BK7\"\n") ==
        "glass-BK7 without dispersion, by its index at 587.6 nm\n");
  CHECK(approximated("Material \"dielectric\" \"spectrum eta\" [400 1.6 700 1.5]\n") ==
        "a refractive index without dispersion, by the spectrum's mean\n");
  CHECK(approximated("", "\"string sensor\" \"nikon_d850\"") ==
        "sensor nikon_d850 by the standard observer\n");
}

TEST_CASE("pbrt: accelerators and options are known by their names") {
  const auto messages = [](const std::string& header) {
    const TemporaryDirectory folder;
    Diagnostics diagnostics;
    pbrt::read_pbrt(folder.write("scene.pbrt", header + "\nWorldBegin\nShape \"sphere\"\n"), {},
                    diagnostics);
    std::string text;
    for (const Diagnostic& d : diagnostics.all()) text += d.to_string() + "\n";
    return text;
  };
  const auto has = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  for (const std::string film : {"Film \"rgb\"\n", "Film \"image\"\n"})
    CHECK_FALSE(
        has(messages(film + "Accelerator \"kdtree\" \"integer maxdepth\" 5\n"), "ccelerator"));
  CHECK(has(messages("Film \"rgb\"\nAccelerator \"bhv\"\n"),
            "2:1: error: there is no Accelerator \"bhv\" (did you mean \"bvh\"?)"));
  CHECK(has(messages("Film \"image\"\nAccelerator \"grid\"\n"),
            "2:1: warning: there is no Accelerator \"grid\""));
  CHECK(has(messages("Film \"rgb\"\nAccelerator \"bvh\" \"integer maxnodes\" 4\n"),
            "warning: Accelerator \"bvh\" has no parameter \"maxnodes\""));
  CHECK(has(messages("Option \"bool wavefrnt\" true\nFilm \"rgb\"\n"),
            "1:8: warning: Option has no parameter \"wavefrnt\""));
}
