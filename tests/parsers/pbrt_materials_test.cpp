// What pbrt's materials and lights become whose parameters are images, or of older versions.
#include <doctest/doctest.h>

#include "image/image_io.h"
#include "lights/environment.h"
#include "scene/build.h"
#include "support/files.h"
#include "support/pbrt_file.h"
#include "values/half_space.h"

using namespace duet;
using namespace duet::test;

namespace {

constexpr const char* kImage = "image.exr";

Image four_pixels() {
  Image image(2, 2, {"R", "G", "B"});
  image.data = {0, 0, 0, 0.5f, 0.25f, 0.75f, 1, 1, 1, 0.5f, 0.5f, 0.5f};
  return image;
}

SceneDescription scene_with_image(const std::string& text) {
  const TemporaryDirectory folder;
  write_exr(folder.path(kImage), four_pixels(), {});
  return scene_of(read_pbrt_file(folder.write("scene.pbrt", text)));
}
SceneDescription v4_file(const std::string& world) {
  return scene_with_image("Film \"rgb\"\nWorldBegin\n" + world);
}
SceneDescription v3_file(const std::string& world) {
  return scene_with_image("Film \"image\"\nWorldBegin\n" + world + "\nWorldEnd\n");
}

const MaterialDescription& material_of(const SceneDescription& d, size_t shape = 0) {
  return d.materials.at(size_t(d.shapes.at(shape).material));
}
const MediumDescription& inside_of(const SceneDescription& d, size_t shape = 0) {
  return d.media.at(size_t(d.shapes.at(shape).interior.value()));
}

double luminance_of_image() {
  return (double(Spectrum(0.5f, 0.25f, 0.75f).luminance()) + 1.5) / 4;
}

}  // namespace

TEST_CASE("pbrt lights with an image have the power that they are given") {
  const std::string image = "\"string filename\" \"image.exr\" \"float power\" 10\n";
  const SceneDescription d = v4_file("LightSource \"goniometric\" " + image +
                                     "LightSource \"projection\" \"float fov\" 60 " + image +
                                     "AreaLightSource \"diffuse\" \"bool twosided\" true " + image +
                                     "Shape \"disk\" \"float radius\" 2\n");
  // The mean of all numbers: 6 / 12.
  const auto& gonio = std::get<GoniometricLight>(d.lights.at(0).model);
  CHECK(gonio.scale.g == doctest::Approx(10 / (4 * 3.14159265 * (1.5 + 3 + 1.5) / 12)));
  // Of the four pixels each has its centre as far from the axis: the cosines are the same.
  const double halved = std::tan(3.14159265 / 6), cos3 = std::pow(1 + halved * halved / 2, -1.5);
  const auto& thrown = std::get<ProjectorLight>(d.lights.at(1).model);
  const auto& scaled = std::get<ScaledTextureDescription>(
      d.textures.at(size_t(std::get<TextureId>(thrown.irradiance))).model);
  CHECK(scaled.scale.g ==
        doctest::Approx(10 / (4 * halved * halved * cos3 * luminance_of_image())).epsilon(1e-4));
  const auto& lamp = std::get<ScaledTextureDescription>(
      d.textures.at(size_t(std::get<TextureId>(d.shapes.at(0).emission->radiance))).model);
  CHECK(
      lamp.scale.g ==
      doctest::Approx(10 / (3.14159265 * 3.14159265 * 4 * 2 * luminance_of_image())).epsilon(1e-3));
}

// Directions at the centres of texels, and one between two of them, are off by 0.005 of the largest
// value at most; an image that is turned, mirrored or upside down is another by 0.25.
TEST_CASE("pbrt-v3: goniometric lights have an image by latitude and longitude, or none") {
  SceneDescription d = v3_file(
      "LightSource \"goniometric\" \"rgb I\" [2 2 1] \"string mapname\" \"image.exr\"\n"
      "LightSource \"goniometric\" \"rgb I\" [3 2 1]\nShape \"sphere\"\n");
  CHECK(std::get<PointLight>(d.lights.at(1).model).intensity == Spectrum(3, 2, 1));
  const TemporaryDirectory folder;
  write_exr(folder.path(kImage), four_pixels(), {});
  std::get<GoniometricLight>(d.lights.at(0).model).file = folder.path(kImage);
  Diagnostics diagnostics;
  const auto scene = build_scene(d, {}, diagnostics);
  REQUIRE(scene);
  const auto towards = [&](const Point3f& p) {
    return scene->lights.at(0)->sample_direct(p, {}).value().weight * length_squared(p - Point3f());
  };
  // pbrt-v3 measures latitude from the light's +y and longitude from its +x towards its +z.
  const auto is = [](const Spectrum& a, const Spectrum& b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)}) < 0.01f;
  };
  CHECK(is(towards({0, 1, 1}), {0, 0, 0}));
  CHECK(is(towards({0, 1, -1}), {1, 0.5f, 0.75f}));
  CHECK(is(towards({0, -1, 1}), {2, 2, 1}));
  CHECK(is(towards({0, -1, -1}), {1, 1, 0.5f}));
  CHECK(is(towards({-1, 1, 0}), {0.5f, 0.25f, 0.375f}));
  CHECK(is(towards({0, 0, 1}), {1, 1, 0.5f}));
}

TEST_CASE("pbrt-v3: the rows of an environment map are centred half a row from the poles") {
  SceneDescription d =
      v3_file("LightSource \"infinite\" \"string mapname\" \"image.exr\"\nShape \"sphere\"\n");
  const auto& map = std::get<EnvironmentMapLight>(d.lights.at(0).model);
  CHECK(map.layout == EnvironmentLayout::row_centers);
  // The folder is gone: the same image again.
  const TemporaryDirectory folder;
  write_exr(folder.path(kImage), four_pixels(), {});
  std::get<EnvironmentMapLight>(d.lights.at(0).model).file = folder.path(kImage);
  Diagnostics diagnostics;
  const auto scene = build_scene(d, {}, diagnostics);
  REQUIRE(scene);
  // The largest blue at an angle from +z.
  const auto largest = [&](double degrees) {
    const double theta = degrees * 3.14159265 / 180;
    float most = 0;
    for (int i = 0; i < 720; ++i) {
      const double phi = i * 3.14159265 / 360;
      const Vector3f w(float(std::sin(theta) * std::cos(phi)),
                       float(std::sin(theta) * std::sin(phi)), float(std::cos(theta)));
      most = std::max(most, scene->environment->emitted({}, w).b);
    }
    return most;
  };
  CHECK(largest(5) == doctest::Approx(0.75).epsilon(1e-3));
  CHECK(largest(45) == doctest::Approx(0.75).epsilon(1e-3));
  CHECK(largest(90) == doctest::Approx(0.625).epsilon(1e-3));
  CHECK(largest(135) == doctest::Approx(1).epsilon(1e-3));
}

TEST_CASE("pbrt: numbers of an image are the mean of its colours in v4, the luminance in v3") {
  const auto channel = [](const SceneDescription& d) {
    return std::get<BitmapTexture>(d.textures.at(0).model).channel;
  };
  const std::string number =
      "Texture \"t\" \"float\" \"imagemap\" \"string filename\" \"image.exr\"\n";
  const std::string color =
      "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"image.exr\"\n";
  CHECK(channel(v4_file(number)) == TextureChannel::number);
  CHECK(channel(v4_file(color)) == TextureChannel::all);
  CHECK(channel(v3_file(number)) == TextureChannel::all);
}

TEST_CASE("pbrt-v4: images that are scaled up end at one") {
  const SceneDescription d = v4_file(
      "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"image.exr\" \"float scale\" "
      "3\nMaterial \"diffuse\" \"texture reflectance\" \"t\"\n");
  // 1 − max(0, 1 − 3x).
  CHECK(std::get<ScaledTextureDescription>(d.textures.at(1).model).scale == Spectrum(3));
  for (const uint32_t i : {2u, 3u}) {
    const auto& f = std::get<FunctionDescription>(d.textures.at(i).model);
    CHECK(f.function == TextureFunction::inverse);
    CHECK(f.inner == TextureId{i - 1});
  }
}

TEST_CASE("pbrt subsurface: a texture of the reflectance tints what enters and leaves") {
  const SceneDescription d = v4_file(
      "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"image.exr\"\n"
      "Texture \"half\" \"spectrum\" \"imagemap\" \"string filename\" \"image.exr\"\n"
      "Material \"subsurface\" \"texture reflectance\" \"t\" \"texture mfp\" \"half\"\nShape "
      "\"sphere\"\n");
  // The largest values are 1, 1, 1, the means 0.5, 0.4375 and 0.5625.
  const MediumDescription& m = inside_of(d);
  const Spectrum extinction = std::get<Spectrum>(m.sigma_t);
  CHECK(extinction.r == doctest::Approx(2));
  CHECK(extinction.g == doctest::Approx(1 / 0.4375));
  CHECK(std::get<Spectrum>(m.albedo).g == doctest::Approx(half_space_albedo(1, 0, 1.33)));
  const auto& glass = material_of(d).model.get<DielectricMaterial>();
  const TextureId tint = std::get<TextureId>(glass.specular_transmittance);
  CHECK(std::get<FunctionDescription>(d.textures.at(size_t(tint)).model).function ==
        TextureFunction::root);
  // No limit of depth, which the events inside would count towards.
  CHECK(std::get<VolumePathIntegratorDescription>(d.integrator.method).max_depth == -1);
  CHECK(d.approximations.size() == 4);
}

TEST_CASE("pbrt subsurface: the scale multiplies the mean free path, known media are even") {
  const SceneDescription d = v4_file(
      "Material \"subsurface\" \"rgb reflectance\" [.5 .5 .5] \"rgb mfp\" [.5 .5 .5] \"float "
      "scale\" 4 \"float g\" .5\nShape \"sphere\"\n"
      "Material \"subsurface\" \"string name\" \"Ketchup\" \"float g\" .5\nShape \"sphere\"\n");
  CHECK(std::get<Spectrum>(inside_of(d, 0).sigma_t).r == doctest::Approx(0.5));
  const auto even = [&](size_t shape) {
    return std::holds_alternative<IsotropicPhase>(
        d.phases.at(size_t(inside_of(d, shape).phase)).model);
  };
  CHECK(!even(0));
  CHECK(even(1));
}

TEST_CASE("pbrt-v3 subsurface: by coefficients, by name and by a diffuse reflectance") {
  const SceneDescription d = v3_file(
      "Material \"subsurface\" \"rgb sigma_a\" [1 1 1] \"rgb sigma_s\" [3 3 3] \"float scale\" 2\n"
      "Shape \"sphere\"\n"
      "Material \"subsurface\" \"string name\" \"Ketchup\" \"rgb Kt\" [.5 .5 .5]\nShape "
      "\"sphere\"\n"
      "Material \"kdsubsurface\" \"rgb Kd\" [.3 .3 .3] \"rgb mfp\" [.1 .1 .1] \"float eta\" 1.5 "
      "\"float scale\" 2\n"
      "Shape \"sphere\"\n"
      "Material \"subsurface\" \"float uroughness\" .2 \"float vroughness\" .2\nShape "
      "\"sphere\"\n");
  CHECK(std::get<Spectrum>(inside_of(d, 0).sigma_t).r == 8);
  CHECK(std::get<Spectrum>(inside_of(d, 0).albedo).r == doctest::Approx(0.75));
  CHECK_FALSE(material_of(d, 0).model.get<DielectricMaterial>().roughness);
  CHECK(std::get<Spectrum>(
            material_of(d, 1).model.get<DielectricMaterial>().specular_transmittance) ==
        Spectrum(0.5f));
  CHECK(std::get<Spectrum>(inside_of(d, 2).sigma_t).r == doctest::Approx(5));
  CHECK(std::get<Spectrum>(inside_of(d, 2).albedo).r ==
        doctest::Approx(half_space_albedo(0.3, 0, 1.5)));
  CHECK(material_of(d, 3).model.get<DielectricMaterial>().roughness);
}

TEST_CASE("pbrt's path sees no media, but in v3 what is beneath surfaces") {
  const std::string world =
      "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\"\nMediumInterface \"fog\" \"\"\n"
      "Shape \"sphere\"\nMaterial \"subsurface\"\nShape \"sphere\"\n";
  const SceneDescription v3 = v3_file(world);
  CHECK_FALSE(v3.shapes.at(0).interior.has_value());
  CHECK(v3.shapes.at(1).interior.has_value());
  CHECK_FALSE(v3.shapes.at(1).exterior.has_value());
  CHECK(std::holds_alternative<VolumePathIntegratorDescription>(v3.integrator.method));
  const SceneDescription v4 = scene_with_image(
      "Film \"rgb\"\nIntegrator \"path\" \"integer maxdepth\" 3\nWorldBegin\n" + world);
  CHECK_FALSE(v4.shapes.at(1).interior.has_value());
  CHECK(std::get<PathIntegratorDescription>(v4.integrator.method).max_depth == 4);
}

TEST_CASE("pbrt-v3 hair, and Disney's material on one or both sides") {
  const SceneDescription d = v3_file(
      "Material \"hair\" \"color color\" [.5 .5 .5] \"float beta_n\" .25\nShape \"sphere\"\n"
      "Material \"disney\" \"color color\" [.1 .2 .3] \"float metallic\" .5 \"float sheentint\" "
      ".25\n"
      "Shape \"sphere\"\n"
      "Material \"disney\" \"float spectrans\" .5 \"float eta\" 1.25\nShape \"sphere\"\n"
      "Material \"disney\" \"bool thin\" \"true\" \"float difftrans\" .5\nShape \"sphere\"\n");
  const auto& hair = material_of(d, 0).model.get<HairMaterial>();
  const double b = 0.25;
  const double f = 5.969 - 0.215 * b + 2.532 * b * b - 10.73 * b * b * b + 5.574 * b * b * b * b +
                   0.245 * b * b * b * b * b;
  CHECK(std::get<Spectrum>(*hair.sigma_a).g == doctest::Approx(std::pow(std::log(0.5) / f, 2)));
  CHECK(hair.eta == FloatInput(1.55));
  const auto& both = material_of(d, 1).model.get<TwoSidedMaterial>();
  const auto& plastic = d.materials.at(size_t(both.front)).model.get<PrincipledMaterial>();
  CHECK(std::get<double>(plastic.metallic) == 0.5);
  CHECK(std::get<double>(plastic.sheen_tint) == 0.25);
  CHECK(std::get<double>(plastic.clearcoat_gloss) == 1);
  CHECK(material_of(d, 2).model.get<PrincipledMaterial>().eta == 1.25);
  CHECK(std::get<double>(material_of(d, 3).model.get<PrincipledThinMaterial>().diff_trans) == 0.5);
}

TEST_CASE("pbrt-v3: texture coordinates are colours, in each unit square anew") {
  const SceneDescription d = v3_file(
      "Texture \"t\" \"color\" \"uv\" \"float uscale\" 3\n"
      "Material \"matte\" \"texture Kd\" \"t\"\nShape \"sphere\"\n");
  const auto& t = std::get<BilerpDescription>(d.textures.at(0).model);
  CHECK(t.repeats);
  CHECK(t.v10 == Spectrum(1, 0, 0));
  CHECK(t.v01 == Spectrum(0, 1, 0));
  CHECK(t.v11 == Spectrum(1, 1, 0));
  CHECK(t.to_uv.m[0][0] == 3);
  const TemporaryDirectory folder;
  const PbrtFile number = read_pbrt_file(
      folder.write("scene.pbrt",
                   "Film \"image\"\nWorldBegin\nTexture \"t\" \"float\" \"uv\"\n"
                   "Material \"matte\" \"texture sigma\" \"t\"\nShape \"sphere\"\nWorldEnd\n"));
  CHECK(number.messages.find("texture coordinates are colours, not numbers") != std::string::npos);
}

TEST_CASE("pbrt-v3 matte and translucent take textures of all their parameters") {
  const SceneDescription d = v3_file(
      "Texture \"s\" \"float\" \"checkerboard\" \"float tex1\" 90\n"
      "Texture \"t\" \"color\" \"checkerboard\"\n"
      "Material \"matte\" \"texture sigma\" \"s\"\nShape \"sphere\"\n"
      "Material \"translucent\" \"texture Kd\" \"t\" \"texture reflect\" \"t\"\nShape "
      "\"sphere\"\n");
  const auto& both = material_of(d, 0).model.get<TwoSidedMaterial>();
  const auto& matte = d.materials.at(size_t(both.front)).model.get<RoughDiffuseMaterial>();
  const auto& alpha = std::get<ScaledTextureDescription>(
      d.textures.at(size_t(std::get<TextureId>(matte.alpha))).model);
  CHECK(alpha.scale.r == doctest::Approx(std::sqrt(2.0) * 3.14159265 / 180));
  const auto& uber = material_of(d, 1).model.get<UberMaterial>();
  const TextureId product = std::get<TextureId>(uber.diffuse_reflectance);
  CHECK(std::holds_alternative<ProductDescription>(d.textures.at(size_t(product)).model));
  const TextureId halved = std::get<TextureId>(uber.diffuse_transmittance);
  CHECK(std::get<ScaledTextureDescription>(d.textures.at(size_t(halved)).model).scale ==
        Spectrum(0.5f));
}
