// What a converted scene needs besides its text: environments of another form, exposure, grids.
#include "evaluate/convert/convert_scene.h"

#include <doctest/doctest.h>

#include <cmath>

#include "image/image_io.h"
#include "mitsuba/mitsuba.h"
#include "pbrt/pbrt.h"
#include "scene/build.h"
#include "support/files.h"
#include "support/images.h"

using namespace duet;
using namespace duet::test;

namespace {

SceneDescription read(const std::string& file) {
  Diagnostics diagnostics;
  std::optional<SceneDescription> d;
  if (file.ends_with(".pbrt")) {
    if (auto scene = pbrt::read_pbrt(file, {}, diagnostics)) d = std::move(scene->description);
  } else if (auto scene = read_mitsuba(file, {}, diagnostics)) {
    d = std::move(scene->description);
  }
  std::string messages;
  for (const Diagnostic& m : diagnostics.all()) messages += m.to_string() + "\n";
  REQUIRE_MESSAGE(d, messages);
  return *std::move(d);
}

/// Converts, writes everything, and reads it again.
SceneDescription converted(const TemporaryDirectory& folder, const std::string& in,
                           const std::string& out, size_t losses) {
  const ConvertedScene scene = convert_scene(read(folder.path(in)), folder.path(out));
  std::string lost;
  for (const std::string& loss : scene.losses) lost += loss + "\n";
  CHECK_MESSAGE(scene.losses.size() == losses, lost);
  CHECK(scene.files.back().path == folder.path(out));
  for (const ConvertedFile& f : scene.files)
    folder.write(std::filesystem::path(f.path).filename().string(), f.bytes);
  return read(folder.path(out));
}

std::unique_ptr<Scene> built(SceneDescription d) {
  Diagnostics diagnostics;
  auto scene = build_scene(std::move(d), {}, diagnostics);
  REQUIRE(scene);
  return scene;
}

/// The largest difference of two environments, relative to the brightest radiance.
double difference(const SceneDescription& a, const SceneDescription& b) {
  const auto first = built(a), second = built(b);
  double largest = 0, worst = 0;
  for (int i = 0; i < 500; ++i) {
    // A spiral over the sphere.
    const double z = 1 - (i + 0.5) / 250, r = std::sqrt(1 - z * z), phi = 2.4 * i;
    const Vector3f w(float(r * std::cos(phi)), float(r * std::sin(phi)), float(z));
    const Spectrum x = first->environment->emitted(Point3f(0), w),
                   y = second->environment->emitted(Point3f(0), w);
    for (int c = 0; c < 3; ++c) {
      largest = std::max(largest, double(x[c]));
      worst = std::max(worst, std::abs(double(x[c]) - double(y[c])));
    }
  }
  CHECK(largest > 0.1);
  return worst / largest;
}

/// Smooth, and different in all directions.
Image waves(int width, int height) {
  Image image(width, height, {"R", "G", "B"});
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double u = 6.2831853 * (x + 0.5) / width, v = 3.1415927 * (y + 0.5) / height;
      image.pixel(x, y)[0] = float(2 + std::cos(u) * std::sin(v));
      image.pixel(x, y)[1] = float(2 + std::sin(u) * std::sin(v));
      image.pixel(x, y)[2] = float(2 + std::cos(v));
    }
  return image;
}

const std::string kHead = "Film \"rgb\"\nPixelFilter \"box\"\nCamera \"perspective\"\n";

}  // namespace

TEST_CASE("convert: environments are the same in the form of the other format") {
  const TemporaryDirectory folder;
  write_exr(folder.path("sky.exr"), waves(128, 65), {});
  folder.write("in.xml",
               "<scene version='3.0.0'><integrator type='path'/><sensor type='perspective'><film "
               "type='hdrfilm'>"
               "<rfilter type='box'/></film></sensor><emitter type='envmap'>"
               "<string name='filename' value='sky.exr'/><float name='scale' value='2'/>"
               "<transform name='to_world'><rotate x='1' y='2' z='3' angle='50'/></transform>"
               "</emitter></scene>");
  const SceneDescription mitsuba = read(folder.path("in.xml"));
  CHECK(difference(mitsuba, converted(folder, "in.xml", "again.xml", 0)) < 1e-5);
  const SceneDescription pbrt = converted(folder, "in.xml", "out.pbrt", 1);
  CHECK(std::get<EnvironmentMapLight>(pbrt.lights.at(0).model).layout ==
        EnvironmentLayout::equal_area);
  CHECK(difference(mitsuba, pbrt) < 0.02);
  CHECK(difference(pbrt, converted(folder, "out.pbrt", "again.pbrt", 0)) < 1e-5);
  CHECK(difference(pbrt, converted(folder, "out.pbrt", "out.xml", 1)) < 0.02);
  // Another rotation is another environment: the bounds above mean something.
  SceneDescription turned = mitsuba;
  turned.lights[0].to_world = Matrix4::rotate(5, 1, 0, 0) * turned.lights[0].to_world;
  CHECK(difference(mitsuba, turned) > 0.03);
}

TEST_CASE("convert: environments of pbrt-v3 and with an illuminance lose neither") {
  const TemporaryDirectory folder;
  write_exr(folder.path("sky.exr"), waves(128, 64), {});
  write_exr(folder.path("square.exr"), waves(64, 64), {});
  folder.write(
      "v3.pbrt",
      "Film \"image\"\nPixelFilter \"box\"\nCamera \"perspective\"\nWorldBegin\nRotate 40 1 2 3\n"
      "LightSource \"infinite\" \"string mapname\" \"sky.exr\" \"rgb L\" "
      "[1 2 3]\nWorldEnd\n");
  const SceneDescription old = read(folder.path("v3.pbrt"));
  CHECK(difference(old, converted(folder, "v3.pbrt", "a.xml", 1)) < 0.02);
  CHECK(difference(old, converted(folder, "v3.pbrt", "a.pbrt", 1)) < 0.02);
  folder.write("v4.pbrt", kHead +
                              "WorldBegin\nLightSource \"infinite\" \"string filename\" "
                              "\"square.exr\" \"float illuminance\" 3\n");
  const SceneDescription bright = read(folder.path("v4.pbrt"));
  CHECK(difference(bright, converted(folder, "v4.pbrt", "b.xml", 1)) < 0.02);
  CHECK(difference(bright, converted(folder, "v4.pbrt", "b.pbrt", 0)) < 1e-5);
}

TEST_CASE("convert: a film's exposure becomes that of all lights where films have none") {
  const TemporaryDirectory folder;
  folder.write(
      "in.pbrt",
      "Film \"rgb\" \"float iso\" 250\nPixelFilter \"box\"\nCamera \"perspective\"\nWorldBegin\n"
      "LightSource \"point\" \"rgb I\" [1 2 4]\n"
      "LightSource \"infinite\" \"rgb L\" [4 2 1]\n"
      "AreaLightSource \"diffuse\" \"rgb L\" [2 4 6] Shape \"sphere\"\n");
  const SceneDescription d = converted(folder, "in.pbrt", "out.xml", 0);
  CHECK(!d.sensors.at(0).film.response);
  CHECK(std::get<PointLight>(d.lights.at(0).model).intensity == Spectrum(2.5f, 5, 10));
  CHECK(std::get<ConstantLight>(d.lights.at(1).model).radiance == Spectrum(10, 5, 2.5f));
  CHECK(std::get<Spectrum>(d.shapes.at(0).emission->radiance) == Spectrum(5, 10, 15));
}

TEST_CASE("convert: meshes, curves and grids without a file get one, with the same content") {
  const TemporaryDirectory folder;
  folder.write(
      "in.pbrt",
      kHead +
          "WorldBegin\nMaterial \"hair\" Shape \"curve\" \"string type\" \"cylinder\" "
          "\"point3 P\" [0 0 0 1 0 0 1 1 0 2 1 0] \"float width\" 0.1\n"
          "Material \"diffuse\" Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0.1 1 0.7] "
          "\"normal N\" [0 0 1 0 0 1 0 0.6 0.8] \"point2 uv\" [0 0 1 0 0.3 1]\n"
          "MakeNamedMedium \"fog\" \"string type\" \"uniformgrid\" \"integer nx\" 2 "
          "\"float density\" [0.1 0.7] MediumInterface \"fog\" \"\" Material \"interface\" "
          "Shape \"sphere\"\n");
  const SceneDescription a = read(folder.path("in.pbrt")),
                         b = converted(folder, "in.pbrt", "out.xml", 1);
  REQUIRE(b.shapes.size() == 3);
  CHECK(std::get<CurvesShape>(a.shapes[0].geometry).curves->points ==
        std::get<CurvesShape>(b.shapes[0].geometry).curves->points);
  TriangleMesh one = *std::get<MeshShape>(a.shapes[1].geometry).mesh;
  // Only bumps ask for them, and the loss is named then.
  CHECK(one.bump_tangents == BumpTangents::across_normals);
  one.bump_tangents = BumpTangents::derivatives;
  CHECK(one == *std::get<MeshShape>(b.shapes[1].geometry).mesh);
  REQUIRE(b.volumes.size() == 1);
  CHECK(a.volumes.at(0).grid->values == b.volumes.at(0).grid->values);
  // Two cells along x and one along the others, in a box that has room for those around them.
  CHECK(b.volumes.at(0).to_world ==
        a.volumes.at(0).to_world * Matrix4::translate(-0.5, -1, -1) * Matrix4::scale(2, 3, 3));
}

TEST_CASE(
    "convert: numbers and linear values of images are those of the other format if it has them") {
  const TemporaryDirectory folder;
  folder.write("grey.png", png(2, 1, 8, 0, std::string("\0\x40\xc0", 3)));
  folder.write("equal.png", png(1, 1, 8, 2, std::string("\0\x40\x40\x40", 4)));
  folder.write("red.png", png(1, 1, 8, 2, std::string("\0\x40\0\0", 4)));
  const auto scene = [](const std::string& image) {
    return kHead +
           "WorldBegin\nTexture \"t\" \"float\" \"imagemap\" \"string encoding\" "
           "\"linear\" \"string filename\" \"" +
           image +
           "\"\n"
           "Material \"conductor\" \"texture roughness\" \"t\" \"bool remaproughness\" false\n"
           "Shape \"sphere\"\n";
  };
  for (const std::string image : {"grey.png", "equal.png", "red.png"}) {
    CAPTURE(image);
    folder.write("in.pbrt", scene(image));
    // Of a red image Mitsuba takes the luminance, and pbrt the mean.
    const SceneDescription xml =
        converted(folder, "in.pbrt", "out.xml", image == "red.png" ? 1 : 0);
    const auto& b = std::get<BitmapTexture>(xml.textures.at(0).model);
    CHECK(b.raw);
    CHECK(b.channel == TextureChannel::all);
    const SceneDescription back =
        converted(folder, "out.xml", "b.pbrt", image == "red.png" ? 1 : 0);
    CHECK(std::get<BitmapTexture>(back.textures.at(0).model).channel == TextureChannel::number);
  }
}

TEST_CASE("convert: what a grid has at its faces is lost where the format goes on beyond them") {
  const TemporaryDirectory folder;
  const auto losses = [&](const std::string& values) {
    SceneDescription d;
    VolumeGrid grid;
    grid.size = {3, 3, 3};
    grid.channels = 1;
    grid.values.assign(27, 0.0f);
    grid.values[13] = 1;
    if (values == "full") grid.values[0] = 1;
    VolumeDescription v;
    v.grid = std::make_shared<const VolumeGrid>(grid);
    v.nodes = VolumeNodes::on_faces;
    d.volumes.push_back(v);
    d.integrator.method = PathIntegratorDescription{};
    return convert_scene(d, folder.path("out.xml")).losses.size();
  };
  CHECK(losses("empty") == 0);
  CHECK(losses("full") == 1);
}
