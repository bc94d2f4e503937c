// What the directives of pbrt files mean for the scene description.
#include <doctest/doctest.h>

#include <cmath>

#include "support/files.h"
#include "support/pbrt_file.h"

using namespace duet;
using namespace duet::test;

namespace {

/// The scene of a text; fails with its messages if there is none.
SceneDescription pbrt_scene(const std::string& text, pbrt::Options options = {}) {
  const TemporaryDirectory folder;
  return scene_of(read_pbrt_file(folder.write("scene.pbrt", text), options));
}

/// A scene of version 4 whose world is `world`, after `header`.
SceneDescription v4_world(const std::string& world, const std::string& header = "") {
  return pbrt_scene(header +
                    "Film \"rgb\" \"integer xresolution\" 40 \"integer yresolution\" 20\n" +
                    "WorldBegin\n" + world);
}
SceneDescription v3_world(const std::string& world) {
  return pbrt_scene("Film \"image\"\nWorldBegin\n" + world + "\nWorldEnd\n");
}

std::array<double, 3> applied(const Matrix4& m, double x, double y, double z) {
  std::array<double, 3> r;
  for (int i = 0; i < 3; ++i) r[size_t(i)] = m[i][0] * x + m[i][1] * y + m[i][2] * z + m[i][3];
  return r;
}

void check_point(const std::array<double, 3>& p, double x, double y, double z) {
  CHECK(p[0] == doctest::Approx(x));
  CHECK(p[1] == doctest::Approx(y));
  CHECK(p[2] == doctest::Approx(z));
}

/// Where the origin of the shape's own space lies.
std::array<double, 3> origin_of(const SceneDescription& scene, size_t shape) {
  return applied(scene.shapes.at(shape).to_world, 0, 0, 0);
}

}  // namespace

TEST_CASE("pbrt transforms multiply from the right, and blocks give them back") {
  const SceneDescription scene = v4_world(
      "AttributeBegin\nTranslate 1 2 3\nScale 2 2 2\nTranslate 1 0 0\nShape \"sphere\"\n"
      "Identity\nRotate 90 0 0 1\nTranslate 1 0 0\nShape \"sphere\"\nAttributeEnd\n"
      "Shape \"sphere\"\n"
      "Transform [1 0 0 0 0 1 0 0 0 0 1 0 4 5 6 1]\nShape \"sphere\"\n"
      "ConcatTransform [1 0 0 0 0 1 0 0 0 0 1 0 1 0 0 1]\nShape \"sphere\"\n");
  REQUIRE(scene.shapes.size() == 5);
  check_point(origin_of(scene, 0), 3, 2, 3);
  check_point(origin_of(scene, 1), 0, 1, 0);
  check_point(origin_of(scene, 2), 0, 0, 0);
  check_point(origin_of(scene, 3), 4, 5, 6);
  check_point(origin_of(scene, 4), 5, 5, 6);
}

TEST_CASE("pbrt coordinate systems have names, and the camera's is one of them") {
  const SceneDescription scene = v4_world(
      "AttributeBegin\nTranslate 1 0 0\nCoordinateSystem \"here\"\nAttributeEnd\n"
      "CoordSysTransform \"here\"\nShape \"sphere\"\n"
      "CoordSysTransform \"camera\"\nTranslate 0 0 2\nShape \"sphere\"\n"
      "CoordSysTransform \"world\"\nShape \"sphere\"\n",
      "LookAt 0 -5 0 0 0 0 0 0 1\nCamera \"perspective\"\n");
  check_point(origin_of(scene, 0), 1, 0, 0);
  check_point(origin_of(scene, 1), 0, -3, 0);
  check_point(origin_of(scene, 2), 0, 0, 0);
}

TEST_CASE("pbrt cameras have x to the right, and their field of view on the shorter side") {
  const SceneDescription scene =
      v4_world("", "LookAt 0 -5 0 0 0 0 0 0 1\nCamera \"perspective\" \"float fov\" 90\n");
  const SensorDescription& sensor = scene.sensors.at(0);
  // Looking along +y with z up, pbrt's camera has the world's −x at the right: that is left in
  // Duet's camera space, +x.
  check_point(applied(sensor.to_world, 0, 0, 1), 0, -4, 0);
  check_point(applied(sensor.to_world, 1, 0, 0), 1, -5, 0);
  check_point(applied(sensor.to_world, 0, 1, 0), 0, -5, 1);
  CHECK(sensor.fov_axis == FovAxis::x);
  CHECK(sensor.fov == doctest::Approx(2 * std::atan(2.0) * 180 / 3.14159265358979));
}

TEST_CASE("pbrt: ReverseOrientation and mirrors turn surfaces inside out") {
  const SceneDescription scene = v4_world(
      "Shape \"sphere\"\nShape \"cylinder\"\nAttributeBegin\nScale -1 1 1\nShape \"sphere\"\n"
      "Shape \"cylinder\"\nReverseOrientation\nShape \"cylinder\"\nAttributeEnd\n"
      "AttributeBegin\nScale -1 1 1\nShape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]\n"
      "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"normal N\" [0 0 1 0 0 1 0 0 1]\n"
      "AttributeEnd\n");
  // A sphere that its own transform mirrors is inside out already, and all are mirrored along z.
  CHECK(scene.shapes[0].flip_normals);
  CHECK(!scene.shapes[1].flip_normals);
  CHECK(scene.shapes[2].flip_normals);
  CHECK(scene.shapes[3].flip_normals);
  CHECK(!scene.shapes[4].flip_normals);
  CHECK(scene.shapes[5].flip_normals);
  CHECK(!scene.shapes[6].flip_normals);
}

TEST_CASE("pbrt: Attribute sets parameters of what comes in its block") {
  const SceneDescription scene = v4_world(
      "AttributeBegin\nAttribute \"shape\" \"float radius\" 2\nShape \"cylinder\"\n"
      "Shape \"cylinder\" \"float radius\" 3\nAttributeEnd\nShape \"cylinder\"\n");
  CHECK(scene.shapes[0].to_world[0][0] == 2);
  CHECK(scene.shapes[1].to_world[0][0] == 3);
  CHECK(scene.shapes[2].to_world[0][0] == 1);
  // Not all that comes in a block has what it sets.
  const TemporaryDirectory folder;
  const auto messages = [&](const std::string& world) {
    return read_pbrt_file(
               folder.write("scene.pbrt",
                            "Film \"rgb\"\nCamera \"orthographic\"\nWorldBegin\n" + world))
        .messages;
  };
  const std::string triangle = "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]";
  CHECK(messages("Attribute \"shape\" \"float radius\" 2\n" + triangle + "\n") == "");
  CHECK(messages(triangle + " \"float radius\" 2\n") != "");
}

TEST_CASE("pbrt instances: the transform at the definition and that at the use") {
  const SceneDescription scene = v4_world(
      "Translate 1 0 0\nObjectBegin \"o\"\nTranslate 0 1 0\nShape \"cylinder\"\nObjectEnd\n"
      "Translate 5 0 0\nObjectInstance \"o\"\n");
  REQUIRE(scene.groups.size() == 1);
  check_point(applied(scene.groups[0].shapes.at(0).to_world, 0, 0, 0.5), 1, 1, 0);
  check_point(origin_of(scene, 0), 6, 0, 0);
}

TEST_CASE("pbrt: what Include changes stays, what Import changes does not") {
  const TemporaryDirectory folder;
  folder.write("moves.pbrt", "Translate 1 0 0\nShape \"sphere\"\n");
  const std::string file =
      folder.write("scene.pbrt",
                   "Film \"rgb\"\nWorldBegin\nImport \"moves.pbrt\"\nShape \"sphere\"\n"
                   "Include \"moves.pbrt\"\nShape \"sphere\"\n");
  Diagnostics diagnostics;
  const auto scene = pbrt::read_pbrt(file, {}, diagnostics);
  REQUIRE(scene.has_value());
  check_point(origin_of(scene->description, 1), 0, 0, 0);
  check_point(origin_of(scene->description, 3), 1, 0, 0);
}

TEST_CASE("pbrt motion: poses of the active transforms at their times") {
  const SceneDescription scene = v4_world(
      "AttributeBegin\nActiveTransform EndTime\nTranslate 2 0 0\nActiveTransform All\n"
      "Translate 0 1 0\nShape \"sphere\"\nAttributeEnd\nShape \"sphere\"\n",
      "TransformTimes 0 4\nCamera \"perspective\" \"float shutterclose\" 2\n");
  REQUIRE(scene.shapes[0].motion.keyframes().size() == 2);
  check_point(applied(scene.shapes[0].motion.at(2), 0, 0, 0), 1, 1, 0);
  CHECK(scene.shapes[1].motion.empty());
  CHECK(scene.sensors[0].shutter == std::array<double, 2>{0, 2});
}

TEST_CASE("pbrt names of textures and materials end with their block in v3 only") {
  const std::string world =
      "AttributeBegin\nMakeNamedMaterial \"m\" \"string type\" \"TYPE\"\nAttributeEnd\n"
      "NamedMaterial \"m\"\nShape \"sphere\"\n";
  const auto with = [&](const char* type) {
    std::string text = world;
    return text.replace(text.find("TYPE"), 4, type);
  };
  CHECK(v4_world(with("diffuse")).shapes.size() == 1);
  // The material before the block holds.
  const SceneDescription old = v3_world(with("mirror"));
  const auto& both =
      old.materials.at(size_t(old.shapes.at(0).material)).model.get<TwoSidedMaterial>();
  CHECK(old.materials.at(size_t(both.front)).model.is<DiffuseMaterial>());
}

TEST_CASE("pbrt film: windows, exposure and filters by pbrt's defaults") {
  const auto film = [](const std::string& more, const std::string& header = "") {
    return pbrt_scene(header +
                      "Film \"rgb\" \"integer xresolution\" 100 \"integer yresolution\" 50 " +
                      more + "\nWorldBegin\n")
        .sensors.at(0)
        .film;
  };
  const FilmDescription cropped = film("\"float cropwindow\" [.25 .801 0 .5]");
  REQUIRE(cropped.crop.has_value());
  CHECK(cropped.crop->x == 25);
  CHECK(cropped.crop->width == 56);
  CHECK(cropped.crop->height == 25);
  CHECK(!film("").response.has_value());
  const FilmDescription bright =
      film("\"float iso\" 200", "Camera \"perspective\" \"float shutterclose\" .25\n");
  REQUIRE(bright.response.has_value());
  CHECK((*bright.response)[1][1] == doctest::Approx(0.5));
  const SceneDescription spectral =
      pbrt_scene("Film \"spectral\" \"integer nbuckets\" 8\nWorldBegin\n");
  CHECK(spectral.sensors.at(0).film.width == 1280);
  REQUIRE(spectral.approximations.size() == 1);
  CHECK(spectral.approximations[0].message == "film spectral by its colours alone");
  CHECK_FALSE(film("").sample_limit.has_value());
  const FilmDescription limited = film("\"float iso\" 200 \"float maxcomponentvalue\" 5");
  REQUIRE(limited.sample_limit.has_value());
  CHECK(limited.sample_limit->most == 5);
  // Of white, Y is one and Z is the largest, and the exposure counts.
  const float white[3] = {10, 10, 10};
  CHECK(limited.sample_limit->share(white) ==
        doctest::Approx(5 / (2 * 10 * 1.08906)).epsilon(1e-3));
  const SceneDescription old = pbrt_scene(
      "Film \"image\" \"float maxsampleluminance\" 5 \"float scale\" 3\nWorldBegin\nWorldEnd\n");
  CHECK(old.sensors.at(0).film.sample_limit->share(white) == doctest::Approx(0.5).epsilon(1e-3));
  CHECK(film("").filter.kind == FilterKind::gaussian);
  CHECK(film("").filter.reach_x == 1.5);
  const FilterDescription wide =
      film("", "PixelFilter \"box\" \"float xradius\" 1.5 \"float yradius\" 1\n").filter;
  CHECK(wide.reach_x == 1.5);
  CHECK(wide.reach_y == 1);
  CHECK(v3_world("").sensors.at(0).film.filter.kind == FilterKind::box);
  CHECK(v3_world("").sensors.at(0).film.width == 1280);
}

TEST_CASE("pbrt lights: v4 brings spectra to luminance 1, v3 takes them as they are") {
  const auto intensity = [](const SceneDescription& scene) {
    return std::get<PointLight>(scene.lights.at(0).model).intensity;
  };
  CHECK(intensity(v4_world("LightSource \"point\" \"rgb I\" [2 3 4] \"float scale\" 2")) ==
        Spectrum(4, 6, 8));
  CHECK(double(intensity(v4_world("LightSource \"point\" \"blackbody I\" 3000")).luminance()) ==
        doctest::Approx(1).epsilon(1e-4));
  const Spectrum flat =
      intensity(v4_world("LightSource \"point\" \"spectrum I\" [300 7 900 7] \"float scale\" 3"));
  CHECK(double(flat.luminance()) == doctest::Approx(3).epsilon(1e-4));
  CHECK(double(flat.r) == doctest::Approx(3 * 1.205).epsilon(1e-3));
  CHECK(double(intensity(v3_world("LightSource \"point\" \"spectrum I\" [300 7 900 7]"))
                   .luminance()) == doctest::Approx(7 * 470.0 / 471).epsilon(1e-4));
  CHECK(intensity(v3_world("LightSource \"point\" \"rgb I\" [1 2 3] \"rgb scale\" [2 1 1]")) ==
        Spectrum(2, 2, 3));
  CHECK(double(intensity(v4_world("LightSource \"point\" \"float power\" 10")).r) ==
        doctest::Approx(10 / (4 * 3.14159265)));
}

TEST_CASE("pbrt mixes: v4's amount is the second material's share, v3's the first one's") {
  const auto blend = [](const SceneDescription& scene) {
    return scene.materials[size_t(scene.shapes.at(0).material)].model.get<BlendMaterial>();
  };
  const BlendMaterial v4 =
      blend(v4_world("MakeNamedMaterial \"a\" \"string type\" \"diffuse\"\n"
                     "MakeNamedMaterial \"b\" \"string type\" \"conductor\"\n"
                     "Material \"mix\" \"string materials\" [\"a\" \"b\"] \"float amount\" "
                     ".25\nShape \"sphere\"\n"));
  CHECK(std::get<double>(v4.weight) == 0.25);
  const BlendMaterial v3 = blend(
      v3_world("MakeNamedMaterial \"a\" \"string type\" \"matte\"\n"
               "MakeNamedMaterial \"b\" \"string type\" \"metal\"\n"
               "Material \"mix\" \"string namedmaterial1\" \"a\" \"string namedmaterial2\" \"b\" "
               "\"rgb amount\" [.25 .25 .25]\nShape \"sphere\"\n"));
  CHECK(std::get<double>(v3.weight) == doctest::Approx(0.25));
  CHECK(size_t(v3.first) > size_t(v3.second));
}

TEST_CASE("pbrt plastic: v3's coat has its indices the other way round") {
  const SceneDescription scene =
      v3_world("Material \"plastic\" \"rgb Ks\" [.5 .5 .5]\nShape \"sphere\"");
  const UberMaterial* coat = nullptr;
  for (const MaterialDescription& m : scene.materials)
    if (const auto* found = m.model.get_if<UberMaterial>()) coat = found;
  REQUIRE(coat);
  CHECK(std::get<double>(coat->eta) == doctest::Approx(1 / 1.5));
  CHECK(coat->glossy_reflectance == ColorInput(Spectrum(0.5f)));
}

TEST_CASE("pbrt roughness: v4's square root, v3's polynomial") {
  const auto alpha = [](const SceneDescription& scene) {
    for (const MaterialDescription& m : scene.materials)
      if (const auto* metal = m.model.get_if<ConductorMaterial>())
        return metal->roughness ? std::get<double>(metal->roughness->alpha_u) : 0.0;
    return -1.0;
  };
  CHECK(alpha(v4_world("Material \"conductor\" \"float roughness\" .25")) == doctest::Approx(0.5));
  CHECK(alpha(v4_world("Material \"conductor\"")) == 0);
  CHECK(alpha(v4_world(
            "Material \"conductor\" \"float roughness\" .25 \"bool remaproughness\" false")) ==
        doctest::Approx(0.25));
  const double x = std::log(0.01);
  CHECK(alpha(v3_world("Material \"metal\"")) ==
        doctest::Approx(1.62142 + 0.819955 * x + 0.1734 * x * x + 0.0171201 * x * x * x +
                        0.000640711 * x * x * x * x));
}

TEST_CASE("pbrt media: surfaces stand between media that differ") {
  const SceneDescription scene = v4_world(
      "MediumInterface \"fog\" \"fog\"\nShape \"sphere\"\nMediumInterface \"fog\" \"\"\n"
      "Shape \"sphere\"\nMakeNamedMedium \"fog\" \"string type\" \"homogeneous\" "
      "\"rgb sigma_a\" [1 1 1] \"rgb sigma_s\" [3 3 3] \"float scale\" 2\n");
  CHECK(!scene.shapes[0].interior.has_value());
  REQUIRE(scene.shapes[1].interior.has_value());
  CHECK(!scene.shapes[1].exterior.has_value());
  const MediumDescription& fog = scene.media.at(size_t(*scene.shapes[1].interior));
  CHECK(std::get<Spectrum>(fog.sigma_t) == Spectrum(4.0f));
  CHECK(std::get<Spectrum>(fog.albedo) == Spectrum(0.75f));
  CHECK(fog.scale == 2);
}

TEST_CASE("pbrt: unknown parameters are warnings that name the nearest one") {
  const TemporaryDirectory folder;
  Diagnostics diagnostics;
  CHECK(pbrt::read_pbrt(
      folder.write("a.pbrt", "Film \"rgb\"\nWorldBegin\nShape \"sphere\" \"float radios\" 2\n"), {},
      diagnostics));
  REQUIRE(diagnostics.all().size() == 2);
  CHECK(diagnostics.all()[0].message.find("did you mean \"radius\"") != std::string::npos);
  CHECK(diagnostics.all()[0].where.line == 3);
  CHECK(diagnostics.all()[0].where.column == 16);
}
