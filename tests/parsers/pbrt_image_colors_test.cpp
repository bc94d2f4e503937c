// Images of pbrt files that are in another colour space than the film.
#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <doctest/doctest.h>

#include "evaluate/convert/convert_scene.h"
#include "image/image_io.h"
#include "scene/build.h"
#include "scene/texture_texels.h"
#include "support/files.h"
#include "support/pbrt_file.h"

using namespace duet;

namespace {

/// Red, green, blue and white, in rows of two.
constexpr float kColors[4][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};

/// ITU-R BT.2087, table 1: from BT.709 to BT.2020, by columns.
constexpr double kTo2020[3][3] = {
    {0.6274, 0.0691, 0.0164}, {0.3293, 0.9195, 0.0880}, {0.0433, 0.0114, 0.8956}};

class Images {
 public:
  Images() {
    Image image(2, 2, {"R", "G", "B"});
    for (size_t i = 0; i < 12; ++i) image.data[i] = kColors[i / 3][i % 3];
    write_exr(folder.path("srgb.exr"), image, {});
    write_display_image(folder.path("srgb.png"), 2, 2, 3,
                        {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255});
    write_named("rec2020.exr", {0.708f, 0.292f}, {0.170f, 0.797f});
    write_named("own.exr", {0.7f, 0.3f}, {0.1f, 0.8f});
  }
  /// Writes by OpenEXR itself the four colours with primaries of their own.
  void write_named(const std::string& name, Imath::V2f red, Imath::V2f green) const {
    Imf::Header header(2, 2);
    Imf::addChromaticities(header, {red, green, {0.131f, 0.046f}, {0.3127f, 0.3290f}});
    Imf::Rgba pixels[4];
    for (int i = 0; i < 4; ++i) pixels[i] = {kColors[i][0], kColors[i][1], kColors[i][2], 1};
    Imf::RgbaOutputFile out(folder.path(name).c_str(), header, Imf::WRITE_RGB);
    out.setFrameBuffer(pixels, 1, 2);
    out.writePixels(2);
  }
  test::PbrtFile read(const std::string& space, const std::string& world) const {
    return test::read_pbrt_file(folder.write(
        "scene.pbrt", "ColorSpace \"" + space +
                          "\"\nCamera \"perspective\"\nFilm \"rgb\"\nWorldBegin\n" + world));
  }
  /// The texels of a texture that shows the image.
  std::vector<Spectrum> texels(const std::string& space, const std::string& image,
                               std::string* messages = nullptr) const {
    test::PbrtFile file =
        read(space, "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"" + image +
                        "\"\nMaterial \"diffuse\" \"texture reflectance\" \"t\"\nShape \"disk\"\n");
    if (messages)
      *messages = file.messages;
    else
      CHECK(file.messages == "");
    const SceneDescription d = test::scene_of(std::move(file));
    return read_texels(std::get<BitmapTexture>(d.textures.at(0).model)).colors;
  }

  test::TemporaryDirectory folder;
};

void check_texel(const Spectrum& c, double r, double g, double b) {
  CHECK(double(c.r) == doctest::Approx(r).epsilon(1e-3).scale(1));
  CHECK(double(c.g) == doctest::Approx(g).epsilon(1e-3).scale(1));
  CHECK(double(c.b) == doctest::Approx(b).epsilon(1e-3).scale(1));
}

}  // namespace

TEST_CASE("pbrt: textures are taken from the image's colour space to the film's") {
  const Images images;
  for (const char* file : {"srgb.exr", "srgb.png"}) {
    const std::vector<Spectrum> same = images.texels("srgb", file);
    for (size_t i = 0; i < 4; ++i)
      check_texel(same[i], double(kColors[i][0]), double(kColors[i][1]), double(kColors[i][2]));
    const std::vector<Spectrum> wide = images.texels("rec2020", file);
    for (size_t i = 0; i < 3; ++i)
      check_texel(wide[i], kTo2020[i][0], kTo2020[i][1], kTo2020[i][2]);
    check_texel(wide[3], 1, 1, 1);
    // Another white: surfaces that reflect all stay white.
    check_texel(images.texels("aces2065-1", file)[3], 1, 1, 1);
  }
  // Green of the wider space is outside of sRGB: it is moved to its edge.
  const std::vector<Spectrum> narrow = images.texels("srgb", "rec2020.exr");
  check_texel(narrow[1], 0, 1.1329, 0);
  check_texel(narrow[3], 1, 1, 1);
  check_texel(images.texels("rec2020", "rec2020.exr")[1], 0, 1, 0);
}

TEST_CASE("pbrt: an image in a colour space that pbrt does not know is taken for sRGB, said so") {
  const Images images;
  std::string messages;
  check_texel(images.texels("srgb", "own.exr", &messages)[0], 1, 0, 0);
  CHECK(messages.find("scene.pbrt:5:1: warning: ") != std::string::npos);
  CHECK(messages.find("own.exr: the colours are taken for sRGB") != std::string::npos);
}

TEST_CASE("pbrt: light of images keeps its chromaticity where the film has another white") {
  const Images images;
  const auto emitted = [&](const std::string& space, const std::string& light) {
    Diagnostics diagnostics;
    const auto scene =
        build_scene(test::scene_of(images.read(
                        space, "LightSource \"infinite\" \"string filename\" \"" + light)),
                    {}, diagnostics);
    REQUIRE(scene);
    return scene->environment->emitted(Point3f(0), normalize(Vector3f(0.3f, 0.2f, 0.9f)));
  };
  // The same white by three channels and by one. D65 in ACES2065-1, from the chromaticities.
  Image white(2, 2, {"R", "G", "B"}), grey(2, 2, {"Y"});
  std::fill(white.data.begin(), white.data.end(), 1.0f);
  std::fill(grey.data.begin(), grey.data.end(), 1.0f);
  write_exr(images.folder.path("white.exr"), white, {});
  write_exr(images.folder.path("grey.exr"), grey, {});
  for (const char* light : {"white.exr\"\n", "grey.exr\"\n"}) {
    check_texel(emitted("srgb", light), 1, 1, 1);
    check_texel(emitted("rec2020", light), 1, 1, 1);
    check_texel(emitted("aces2065-1", light), 0.9977, 1.0090, 1.0795);
  }
}

TEST_CASE("pbrt: converted scenes have images in the colours of the film") {
  const Images images;
  const SceneDescription d = test::scene_of(
      images.read("rec2020",
                  "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"srgb.png\"\n"
                  "Material \"diffuse\" \"texture reflectance\" \"t\"\nShape \"disk\"\n"));
  for (const char* name : {"new.xml", "new.pbrt"}) {
    const ConvertedScene converted = convert_scene(d, images.folder.path(name));
    for (const std::string& loss : converted.losses)
      CHECK(loss.find("colour") == std::string::npos);
    REQUIRE(converted.files.size() >= 2);
    images.folder.write("made.exr", converted.files[0].bytes);
    const ImageFile made = read_image(images.folder.path("made.exr"));
    CHECK(double(made.image.data[0]) == doctest::Approx(kTo2020[0][0]).epsilon(1e-3));
  }
}
