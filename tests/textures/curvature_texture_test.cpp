// Curvature as a colour, as in Mitsuba 0.6.
#include "textures/curvature_texture.h"

#include <doctest/doctest.h>

#include "support/textured_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

std::string coloured(const std::string& shape, const std::string& kind, const std::string& scale) {
  return "<shape type='" + shape + "<bsdf type='diffuse'><texture type='curvature' " +
         "name='reflectance'><string name='curvature' value='" + kind +
         "'/><float name='scale' value='" + scale + "'/></texture></bsdf></shape>";
}

Spectrum seen(const std::string& content, float x = 0.1f, float y = 0.2f) {
  return TexturedScene("0.6.0", content).albedo(x, y);
}

void check(const Spectrum& c, double r, double b) {
  CHECK(c.r == doctest::Approx(r).epsilon(1e-3));
  CHECK(c.g == 0);
  CHECK(c.b == doctest::Approx(b).epsilon(1e-3));
}

}  // namespace

TEST_CASE("positive curvature is red, negative is blue, both end at one") {
  const std::string ball = "sphere'><float name='radius' value='4'/>";
  const std::string inside_out = ball + "<boolean name='flipNormals' value='true'/>";
  check(seen(coloured(ball, "mean", "2")), 0, 0.5);
  check(seen(coloured(inside_out, "mean", "2")), 0.5, 0);
  check(seen(coloured(ball, "gaussian", "8")), 0.5, 0);
  check(seen(coloured(ball, "mean", "100")), 0, 1);
  check(seen(coloured(ball, "gaussian", "100")), 1, 0);
  check(seen(coloured("rectangle'>", "mean", "2")), 0, 0);
  check(seen(coloured("disk'>", "mean", "2")), 0, 0);
  const std::string tube =
      "cylinder'><float name='radius' value='0.5'/><point name='p0' x='-3' y='0' z='0'/><point "
      "name='p1' "
      "x='3' y='0' z='0'/>";
  check(seen(coloured(tube, "mean", "0.25")), 0, 0.25);
  check(seen(coloured(tube, "gaussian", "1")), 0, 0);
}

TEST_CASE("copies show the curvature of the shape in its group") {
  const std::string group = "<shape type='shapegroup' id='g'>" +
                            coloured("sphere'><float name='radius' value='4'/>", "mean", "2") +
                            "</shape>";
  for (const char* place :
       {"<rotate x='1' angle='70'/><translate x='0.3' z='-9'/>", "<scale value='3'/>"})
    check(seen(group + "<shape type='instance'><ref id='g'/><transform name='toWorld'>" + place +
               "</transform></shape>"),
          0, 0.5);
}

TEST_CASE("shapes without a known curvature are refused where they stand") {
  CurveSet curves;
  curves.points = {{{0, 0, 0}, 0.1f}, {{1, 0, 0}, 0.1f}};
  curves.segments = {0};
  ReadResult read = read_scene("0.6.0", coloured("sphere'>", "mean", "2"));
  REQUIRE(read.scene);
  SceneDescription& d = read.scene->description;
  CurvesShape shape;
  shape.curves = std::make_shared<CurveSet>(curves);
  d.shapes.at(0).geometry = shape;
  CHECK(!build_scene(d, {}, read.diagnostics));
  CHECK_MESSAGE(read.has("scene.xml:2:1: error: this shape has no known curvature, which a texture "
                         "on it reads"),
                read.messages());
}

TEST_CASE("lights without a shape cannot have textures that read one") {
  for (const char* type : {"curvature'><float name='scale' value='1'/>", "wireframe'>"}) {
    TexturedScene s("0.6.0", std::string("<emitter type='spot'><texture name='texture' type='") +
                                 type + "</texture></emitter>");
    CHECK(!s.scene);
    CHECK_MESSAGE(s.read.has("scene.xml:2:1: error: this light has no shape, which a texture of it "
                             "reads"),
                  s.read.messages());
  }
}

TEST_CASE("the gradient of curvature is that of its colour's luminance") {
  // An ellipsoid, whose curvature varies.
  Shape shape;
  shape.kind = ShapeKind::sphere;
  const Matrix4 m = Matrix4::scale(1, 2, 3);
  shape.to_world = Transform(m);
  shape.to_local = *m.inverse();
  CurvatureMap texture(CurvatureKind::gaussian, 0.7f);
  REQUIRE(texture.add_shape(shape, false).empty());
  Surface s;
  s.shape = &shape;
  s.uv = {0.2f, 0.3f};
  const Point2f g = texture.gradient(s);
  CHECK(std::abs(g.x) > 0.05f);
  Surface moved = s;
  moved.uv = {0.21f, 0.29f};
  const float change = texture.value(moved) - texture.value(s);
  CHECK(change / (0.01f * (g.x - g.y)) == doctest::Approx(1).epsilon(0.05));
}
