// Height images from a scene's XML to where rays meet them.
#include <doctest/doctest.h>

#include <cmath>

#include "geometry/accel.h"
#include "geometry/surface.h"
#include "image/image_io.h"
#include "mitsuba/writer.h"
#include "support/images.h"
#include "support/transport_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

/// A folder with the images that the scenes name.
struct Folder : TemporaryDirectory {
  void exr(const std::string& name, int width, int height, std::vector<float> values,
           const std::vector<std::string>& channels = {"Y"}) const {
    Image image(width, height, channels);
    image.data = std::move(values);
    ExrOptions options;
    options.half = false;
    write_exr(path(name), image, options);
  }
};

struct Built {
  Diagnostics diagnostics;
  std::unique_ptr<Scene> scene;
  std::optional<SceneDescription> description;

  Built(const Folder& folder, const std::string& shapes, const char* version = "0.6.0") {
    auto read =
        read_mitsuba(folder.write("scene.xml", scene_text(version, shapes)), {}, diagnostics);
    if (!read) return;
    description = read->description;
    BuildOptions options;
    options.layer_needs = {true, true};
    scene = build_scene(read->description, options, diagnostics);
  }
  /// Without the folder's name.
  bool has(const std::string& text) const {
    for (const Diagnostic& d : diagnostics.all())
      if (d.to_string().find(text) != std::string::npos) return true;
    return false;
  }
  /// Straight down, or straight up from below.
  Surface look(float x, float y, float direction = -1) const {
    const Ray ray{{x, y, -100 * direction}, {0, 0, direction}, INFINITY};
    Hit hit;
    REQUIRE(scene);
    REQUIRE(scene->accel->closest_hit(ray, hit));
    return make_surface(scene->shapes[hit.shape], nullptr, ray, hit);
  }
};

std::string field(const std::string& content) {
  return "<shape type='heightfield'>" + content + "</shape><emitter type='constant'/>";
}
std::string named(const std::string& file, const std::string& content = "") {
  return field("<string name='filename' value='" + file + "'/>" + content);
}

}  // namespace

TEST_CASE("height field: rays straight down meet the bilinear surface of the image") {
  const Folder folder;
  // Nothing is resampled: 5 and 3 are one more than powers of two.
  std::vector<float> values;
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 5; ++x) values.push_back(float((x - 2) * (y - 1)) / 4);
  folder.exr("saddle.exr", 5, 3, values);
  const Built built(folder, named("saddle.exr", "<float name='scale' value='2'/>"));
  REQUIRE(built.diagnostics.all().empty());
  for (const auto& [x, y] : {std::pair{0.3f, 0.4f}, {-0.9f, 0.7f}, {0.11f, -0.83f}, {-0.5f, 0.f}}) {
    const Surface s = built.look(x, y);
    CHECK(s.position.z == doctest::Approx(x * y).epsilon(0.01));
    CHECK(s.uv.x == doctest::Approx(0.5 * (double(x) + 1)));
    CHECK(s.uv.y == doctest::Approx(0.5 * (double(y) + 1)));
    CHECK(dot(Vector3f(s.shading.n), normalize(Vector3f(-y, -x, 1))) > 0.995f);
    CHECK(s.ng.z > 0);
  }
  CHECK(built.scene->features.bounds.upper.z == doctest::Approx(1));
}

TEST_CASE("height field: flipped, moved and turned") {
  const Folder folder;
  folder.exr("ramp.exr", 2, 2, {0, 1, 0, 1});
  const Surface up = Built(folder, named("ramp.exr")).look(0.5f, 0.25f);
  CHECK(up.position.z == doctest::Approx(0.75));
  CHECK(dot(Vector3f(up.shading.n), normalize(Vector3f(-0.5f, 0, 1))) > 0.99999f);
  const Surface down =
      Built(folder, named("ramp.exr", "<boolean name='flipNormals' value='true'/>"))
          .look(0.5f, 0.25f);
  CHECK(dot(Vector3f(down.shading.n), Vector3f(up.shading.n)) < -0.99999f);
  const Surface moved = Built(folder, named("ramp.exr",
                                            "<transform name='toWorld'><scale x='2' y='3' z='4'/>"
                                            "<translate x='10' z='1'/></transform>"))
                            .look(11, 0.75f);
  CHECK(moved.position.z == doctest::Approx(4));
  CHECK(dot(Vector3f(moved.shading.n), normalize(Vector3f(-1, 0, 1))) > 0.99999f);
  CHECK(moved.uv.x == doctest::Approx(0.75));
  CHECK(moved.uv.y == doctest::Approx(0.625));
}

TEST_CASE("height field: display images are decoded, colours become luminance") {
  const Folder folder;
  folder.write("grey.png", png(2, 2, 8, 0, std::string("\0\x80\x80\0\x80\x80", 6)));
  CHECK(Built(folder, named("grey.png")).look(0, 0).position.z ==
        doctest::Approx(double(srgb_to_linear(128 / 255.0f))));
  folder.write("green.png", png(1, 1, 8, 2, std::string("\0\0\xff\0", 4)));
  CHECK(Built(folder, named("green.png")).look(0.3f, -0.7f).position.z ==
        doctest::Approx(0.715160));
  // A texture says itself how it is decoded.
  const std::string raw =
      "<texture type='bitmap'><string name='filename' value='grey.png'/>"
      "<float name='gamma' value='1'/></texture>";
  CHECK(Built(folder, field(raw)).look(0, 0).position.z == doctest::Approx(128 / 255.0));
  CHECK(Built(folder,
              field("<texture type='scale'><float name='scale' value='3'/>" + raw + "</texture>"))
            .look(0, 0)
            .position.z == doctest::Approx(3 * 128 / 255.0));
}

TEST_CASE("height field: images of other sizes are enlarged, with the filter that is given") {
  const Folder folder;
  folder.exr("step.exr", 4, 1, {0, 0, 1, 1});
  // With a box, five heights over four pixels: the nearest pixels to 0.4, 1.2, 2, 2.8 and 3.6.
  const Built box(folder, named("step.exr", "<rfilter type='box'/>"));
  CHECK(box.look(-0.75f, 0).position.z == doctest::Approx(0));
  CHECK(box.look(0.25f, 0).position.z == doctest::Approx(1).epsilon(0.01));
  // Lanczos overshoots beside the step.
  const Built lanczos(folder, named("step.exr"));
  CHECK(lanczos.look(0.5f, 0).position.z > 1.01f);
  CHECK(lanczos.look(0, 0.5f).position.z == doctest::Approx(0.5));
}

TEST_CASE("height field: textures without an image are looked up at the middles of pixels") {
  const Folder folder;
  const std::string board =
      "<texture type='checkerboard'><float name='color0' value='1'/><float name='color1' "
      "value='0'/></texture>";
  const Built large(folder, field(board + "<integer name='width' value='65'/>"
                                          "<integer name='height' value='17'/>"));
  REQUIRE(large.scene);
  CHECK(large.look(-0.5f, -0.5f).position.z == 1);
  CHECK(large.look(0.5f, -0.5f).position.z == 0);
  CHECK(large.look(0.5f, 0.5f).position.z == 1);
  // The lines lie along the edges of the image, where no pixel has its middle.
  const Built lines(folder,
                    field("<texture type='gridtexture'><float name='color0' value='1'/><float "
                          "name='color1' value='0'/><float name='lineWidth' value='0.05'/>"
                          "</texture><integer name='width' value='5'/>"
                          "<integer name='height' value='5'/>"));
  CHECK(lines.look(-0.75f, -0.75f).position.z == 1);
  // It is not scaled: as an image it is itself.
  const Built scaled(folder,
                     field("<texture type='checkerboard'><float name='color0' value='1'/><float "
                           "name='color1' value='0'/><float name='uscale' value='2'/></texture>"));
  CHECK(scaled.look(-0.25f, -0.5f).position.z == 1);
  CHECK(scaled.look(0.25f, -0.5f).position.z == 0);
  const Built small(folder, field(board));
  // 32 × 32, enlarged to 33 × 33; one number alone changes nothing.
  CHECK(small.description->shapes[0].geometry ==
        Built(folder, field(board + "<integer name='width' value='65'/>"))
            .description->shapes[0]
            .geometry);
  CHECK(small.scene->shapes[0].mesh->triangles.size() % (32 * 32) == 0);
}

TEST_CASE("height field: renders as the same surface in another form") {
  const Folder folder;
  folder.exr("flat.exr", 2, 2, {0, 0, 0, 0});
  folder.exr("ramp.exr", 2, 2, {-1, 0.5f, -1, 0.5f});
  folder.write("ramp.obj",
               "v -1 -1 -1\nv 1 -1 0.5\nv 1 1 0.5\nv -1 1 -1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
               "f 1/1 2/2 3/3 4/4\n");
  const auto image = [&](const std::string& shape) {
    const TransportScene scene(
        folder,
        "<integrator type='path'/>" + camera_xml("0,-3,3", "0,0,0", 24) + "<shape type='" + shape +
            "<bsdf type='diffuse'><texture name='reflectance' type='checkerboard'/></bsdf></shape>"
            "<emitter type='directional'><vector name='direction' x='1' y='1' z='-1'/></emitter>" +
            sphere_xml("0.5,0,0.7", "0.3", grey("0.5")));
    return scene.render("path", {}, 4, 1).image.data;
  };
  const auto flat = image("heightfield'><string name='filename' value='flat.exr'/>");
  CHECK(flat == image("rectangle'>"));
  const auto ramp = image("heightfield'><string name='filename' value='ramp.exr'/>");
  CHECK(ramp == image("obj'><string name='filename' value='ramp.obj'/><boolean "
                      "name='flip_tex_coords' value='false'/>"));
  CHECK(ramp != flat);
}

TEST_CASE("height field: in groups, and with a light on it") {
  const Folder folder;
  folder.exr("ramp.exr", 2, 2, {0, 1, 0, 1});
  const std::string shape = "<shape type='heightfield'><string name='filename' value='ramp.exr'/>";
  const Built group(folder, "<shape type='shapegroup' id='g'>" + shape +
                                "</shape></shape><shape type='instance'><ref id='g'/></shape>");
  REQUIRE(group.scene);
  CHECK(group.scene->features.placed_triangles == 2);
  const Built lamp(folder, shape + "<emitter type='area'/></shape>");
  REQUIRE(lamp.scene);
  CHECK(lamp.scene->lights.size() == 1);
}

TEST_CASE("height field: what it cannot be made of is said") {
  const Folder folder;
  folder.exr("ramp.exr", 2, 2, {0, 1, 0, 1});
  folder.exr("nan.exr", 3, 2, {0, 1, 0, 1, NAN, 0});
  folder.exr("inf.exr", 1, 1, {INFINITY});
  folder.exr("large.exr", 2, 2, {0, 1e30f, 0, 1});
  folder.write("cut.png", "\x89PNG\r\n\x1a\n");
  CHECK(Built(folder, named("none.exr")).has("scene.xml:2:51: error: file \"none.exr\" not found"));
  CHECK(Built(folder, field("")).has("needs one image"));
  CHECK(Built(folder, named("ramp.exr", "<texture type='checkerboard'/>")).has("needs one image"));
  CHECK(Built(folder, named("nan.exr")).has("nan.exr: has numbers that are not finite (1)"));
  CHECK(Built(folder, named("inf.exr")).has("inf.exr: has numbers that are not finite (1)"));
  CHECK(Built(folder, named("large.exr", "<float name='scale' value='1e20'/>"))
            .has("the height of pixel (1, 0) is not finite"));
  CHECK(Built(folder, named("cut.png")).has("scene.xml:2:51: error: "));
  CHECK(Built(folder, field("<texture type='vertexcolors'/>")).has("this texture is no image"));
  CHECK(Built(folder, field("<texture type='checkerboard'><texture name='color0' "
                            "type='vertexcolors'/></texture>"))
            .has("cannot be read from the attributes of a mesh"));
  CHECK(Built(folder, named("ramp.exr", "<integer name='width' value='0'/>"))
            .has("must be from 1 to 65536"));
  CHECK(Built(folder, field("<texture type='checkerboard'/><integer name='width' value='60000'/>"
                            "<integer name='height' value='5000'/>"))
            .has("a height field of 60000 × 5000 pixels is too large"));
}

TEST_CASE("height field: Mitsuba 3 has none, Duet reads it again") {
  const Folder folder;
  folder.exr("ramp.exr", 2, 2, {0, 1, 0, 1});
  const Built built(
      folder, named("ramp.exr",
                    "<float name='scale' value='3'/><boolean name='shadingNormals' value='false'/>"
                    "<rfilter type='tent'/>"));
  REQUIRE(built.description);
  const MitsubaXml xml = write_mitsuba_xml(*built.description);
  CHECK(xml.losses ==
        std::vector<std::string>{"the shape \"heightfield\" does not exist in Mitsuba 3"});
  Diagnostics diagnostics;
  const auto again = read_mitsuba(folder.write("again.xml", xml.text), {}, diagnostics);
  REQUIRE(again);
  CHECK(again->description == *built.description);
}
