// A shape that nobody else knows: all of it is in this file.
#include <doctest/doctest.h>

#include "evaluate/report/description_text.h"
#include "evaluate/report/vocabulary_text.h"
#include "mitsuba/plugins/shape.h"
#include "mitsuba/plugins/shapes.h"
#include "pbrt/writer.h"
#include "scene/builder.h"
#include "scene/content_hash.h"
#include "support/foreign_plugin.h"
#include "support/transport_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

/// A pyramid over the square from (−1, −1) to (1, 1).
struct PyramidShape {
  double height = 1;

  static constexpr auto fields() {
    using namespace parameter_words;
    return FieldList(
        field(&PyramidShape::height, Parameter{"height", number, kInitial, "of the tip", positive})
            .shown(", height ")
            .terse());
  }
  static constexpr const char* name() { return "pyramid"; }
  std::shared_ptr<const TriangleMesh> triangles() const {
    TriangleMesh mesh;
    mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, float(height)}};
    mesh.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {2, 1, 0}, {0, 3, 2}};
    return std::make_shared<TriangleMesh>(std::move(mesh));
  }
};

const ForeignPlugin& pyramid_reader() {
  static const ForeignPlugin p(PluginKind::shape,
                               plugins::surface<PyramidShape>(plugins::flip_normals()));
  return p;
}

SceneDescription good_shape(const std::string& version, const std::string& content) {
  return pyramid_reader().good(scene_text(version, "<emitter type='constant'/>" + content));
}

const std::string kSteep =
    "<shape type='pyramid' id='steep'><float name='height' value='2'/><bsdf type='diffuse'/>"
    "</shape>";

}  // namespace

TEST_CASE("a foreign shape is read by its fields, with their defaults, ranges and spellings") {
  const SceneDescription d = good_shape("3.0.0", kSteep);
  CHECK(std::get<ForeignShape>(d.shapes.at(0).geometry).get<PyramidShape>().height == 2);
  CHECK(good_shape("0.6.0", kSteep) == d);
  CHECK(!(good_shape("3.0.0", "<shape type='pyramid'><bsdf type='diffuse'/></shape>") == d));
  CHECK(good_shape("3.0.0",
                   "<shape type='pyramid'><boolean name='flip_normals' value='true'/></shape>")
            .shapes[0]
            .flip_normals);
  CHECK(pyramid_reader()
            .read(scene_text("3.0.0",
                             "<shape type='pyramid'><float name='height' value='0'/></shape>"))
            .has("the parameter \"height\" of <shape type=\"pyramid\"> must be positive, not 0"));
  CHECK(!read_scene("3.0.0", "<shape type='pyramid'/>").scene);
}

TEST_CASE("a foreign shape has what all surfaces have") {
  const SceneDescription d =
      good_shape("3.0.0",
                 "<shape type='pyramid'><transform name='to_world'><translate "
                 "x='100'/></transform><boolean name='flip_normals' value='true'/>"
                 "<medium name='interior' type='homogeneous'/></shape>");
  CHECK(d.shapes.at(0).to_world[0][3] == 100);
  CHECK(d.shapes[0].interior.has_value());
  pyramid_reader().round_trip(d);
}

TEST_CASE("a foreign shape is listed, written, printed, counted and hashed") {
  const std::string table = compatibility_section(PluginKind::shape, pyramid_reader().vocabulary());
  CHECK(table.find("| `pyramid` | 0.x, 3.x | done |") != table.npos);
  CHECK(table.find("| `height` | float | `1` | 0.x, 3.x | done | of the tip |") != table.npos);
  const SceneDescription d = good_shape("3.0.0", kSteep);
  CHECK(DescriptionText(d).shape(d.shapes[0]) == "pyramid, height 2 steep, bsdf #0");
  const SceneFeatures features = scene_features(d);
  CHECK(features.meshes == 1);
  CHECK(features.triangles == 6);
  CHECK(features.bounds.upper.z == 2);

  pyramid_reader().round_trip(d);
  CHECK(content_hash(good_shape("3.0.0", "<shape type='pyramid'><bsdf type='diffuse'/></shape>")) !=
        content_hash(d));
  const auto lost = pbrt::write_pbrt(d).losses;
  CHECK(std::find(lost.begin(), lost.end(), "a shape is missing: pbrt-v4 has no \"pyramid\"") !=
        lost.end());
}

TEST_CASE("a foreign shape is rendered by all methods, as it stands, moves and shines") {
  // What is convex sees nothing but the sky: it shows its reflectance.
  const auto scene_of = [](const std::string& sky, const std::string& shape) {
    return "<scene version='0.6.0'>" + sky +
           camera_xml("0,-3,1", "0,0,0.5", 4, "perspective",
                      "<float name='shutterOpen' value='0'/><float name='shutterClose' "
                      "value='1'/>") +
           "<shape type='pyramid'><float name='height' value='2'/>" + shape + "</shape></scene>";
  };
  const std::string sky = "<emitter type='constant'/>";
  const std::string grey =
      "<bsdf type='diffuse'><rgb name='reflectance' value='0.25 0.25 0.25'/></bsdf>";
  const std::string swings =
      "<animation name='toWorld'><transform time='0'><translate z='0'/></transform>"
      "<transform time='1'><translate z='0.1'/></transform></animation>";
  const auto check = [](const std::string& text, std::initializer_list<const char*> methods,
                        double expected) {
    ReadResult r = pyramid_reader().read(text);
    REQUIRE_MESSAGE(r.scene, r.messages());
    const TransportScene scene(std::move(r.scene->description));
    for (const char* method : methods) {
      CAPTURE(method);
      const Image image = scene.render(method, {}, 64, 1).image;
      CHECK(double(image.pixel(1, 2)[0]) == doctest::Approx(expected).epsilon(0.05));
    }
  };
  check(scene_of(sky, grey), {"path", "direct", "bdpt", "vcm"}, 0.25);
  check(scene_of(sky, grey + swings), {"path", "bdpt"}, 0.25);
  const std::string elsewhere = "<transform name='toWorld'><translate x='100'/></transform>";
  check(scene_of(sky, grey + elsewhere), {"path", "bdpt"}, 1);
  // In the middle of the time it stands in view, and hardly before and after.
  const std::string passes =
      "<animation name='toWorld'><transform time='0'><translate x='-5000'/></transform>"
      "<transform time='1'><translate x='5000'/></transform></animation>";
  check(scene_of(sky, grey + passes), {"path", "bdpt"}, 1);
  const std::string shines = "<emitter type='area'><rgb name='radiance' value='3 3 3'/></emitter>";
  check(scene_of("", shines), {"path", "bdpt"}, 3);
  check(scene_of("", shines + passes), {"path", "bdpt"}, 0);
}
