// The lines along the edges of meshes, as Mitsuba 0.6 draws them.
#include "textures/wireframe.h"

#include <doctest/doctest.h>

#include <cmath>

#include "support/textured_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

const Spectrum kInterior(0.8f, 0.6f, 0.4f), kEdge(0.1f, 0.2f, 0.3f);

/// From (−1, −1) to (1, 1), cut along the diagonal x = y.
TriangleMesh square() {
  TriangleMesh m;
  m.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  m.triangles = {{0, 1, 2}, {0, 2, 3}};
  return m;
}

/// What the texture has at a place of the square.
double interior_share(double x, double y, double width, double step) {
  const double diagonal = std::abs(x - y) / std::sqrt(2.0);
  const double d = x > y ? std::min({y + 1, 1 - x, diagonal}) : std::min({1 - y, x + 1, diagonal});
  const double t = std::clamp((d - width * (1 - step)) / (width * step), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

struct Square {
  Shape shape;
  explicit Square(TriangleMesh mesh) { shape.mesh = std::make_shared<TriangleMesh>(mesh); }

  /// At a place of the square.
  Surface at(float x, float y) const {
    Surface s;
    s.shape = &shape;
    s.primitive = x > y ? 0 : 1;
    const float a = 0.5f * (x + 1), b = 0.5f * (y + 1);
    s.barycentric = x > y ? Point2f{a - b, b} : Point2f{a, b - a};
    return s;
  }
};

void check_color(const Spectrum& c, double share) {
  for (int k = 0; k < 3; ++k)
    CHECK(c[k] == doctest::Approx(kEdge[k] * (1 - share) + kInterior[k] * share).epsilon(1e-4));
}

}  // namespace

TEST_CASE("a wireframe is drawn by the distance from the nearest edge of the triangle") {
  const Square square_shape(square());
  const double edges = (4 + 2 * std::sqrt(2.0)) / 3;
  for (const std::optional<float> width : {std::optional<float>(0.3f), std::optional<float>()})
    for (const float step : {0.5f, 1.0f, 0.25f}) {
      Wireframe texture({kInterior, kEdge, width, step});
      REQUIRE(texture.add_shape(square_shape.shape, true).empty());
      const double w = width ? double(*width) : 0.1 * edges;
      int lines = 0, between = 0;
      for (int i = 0; i < 400; ++i) {
        const float x = -0.95f + 0.1f * float(i % 20), y = -0.97f + 0.0973f * float(i / 20);
        const double share = interior_share(x, y, w, step);
        CAPTURE(x);
        CAPTURE(y);
        const Surface s = square_shape.at(x, y);
        check_color(texture.color(s), share);
        CHECK(texture.value(s) == doctest::Approx(texture.color(s).luminance()));
        lines += share == 0, between += share > 0 && share < 1;
      }
      CHECK((step == 1 || lines > 10));
      CHECK(between > 3);
    }
}

TEST_CASE("a wireframe without a step has sharp lines") {
  const Square square_shape(square());
  Wireframe texture({kInterior, kEdge, 0.2f, 0});
  texture.add_shape(square_shape.shape, true);
  check_color(texture.color(square_shape.at(0.5f, -0.81f)), 0);
  check_color(texture.color(square_shape.at(0.5f, -0.79f)), 1);
}

TEST_CASE("a wireframe's gradient says how it changes") {
  TriangleMesh mesh = square();
  for (const bool with_uvs : {false, true}) {
    if (with_uvs) mesh.uvs = {{0, 0}, {2, 0.1f}, {2.2f, 1}, {0.3f, 1.2f}};
    const Square square_shape(mesh);
    Wireframe texture({kInterior, kEdge, 0.3f, 0.8f});
    texture.add_shape(square_shape.shape, true);
    int sloped = 0;
    for (int i = 0; i < 100; ++i) {
      const float x = -0.93f + 0.19f * float(i % 10), y = -0.97f + 0.21f * float(i / 10);
      const Surface s = square_shape.at(x, y);
      const Point2f g = texture.gradient(s);
      const auto& t = mesh.triangles[s.primitive];
      // By a small step of the barycentric coordinates, and what it is in texture coordinates.
      for (const Point2f& step : {Point2f{1e-3f, 0}, Point2f{0, 1e-3f}}) {
        Surface before = s, after = s;
        before.barycentric = s.barycentric - step, after.barycentric = s.barycentric + step;
        Point2f uv = step;
        if (with_uvs)
          uv = (mesh.uvs[t[1]] - mesh.uvs[t[0]]) * step.x +
               (mesh.uvs[t[2]] - mesh.uvs[t[0]]) * step.y;
        const float change = 0.5f * (texture.value(after) - texture.value(before));
        CHECK(std::abs(g.x * uv.x + g.y * uv.y - change) < 2e-5f);
        sloped += std::abs(change) > 1e-4f;
      }
    }
    CHECK(sloped > 20);
  }
}

TEST_CASE("in scenes, meshes have lines and other shapes have none") {
  const std::string lines =
      "<bsdf type='diffuse'><texture type='wireframe' name='reflectance'><rgb name='interiorColor' "
      "value='0.8 0.6 0.4'/><rgb name='edgeColor' value='0.1 0.2 0.3'/><float name='lineWidth' "
      "value='0.2'/></texture></bsdf>";
  const auto seen = [&](const std::string& shape, float x, float y) {
    return TexturedScene("0.6.0", shape + lines + "</shape>").albedo(x, y);
  };
  const std::string wide = "<transform name='toWorld'><scale x='10' y='10'/></transform>";
  check_color(seen("<shape type='cube'>", 0.95f, -0.9f), 0);
  check_color(seen("<shape type='cube'>", 0.5f, -0.2f), 1);
  // Lines are as wide as the world is.
  check_color(seen("<shape type='cube'>" + wide, 9.5f, -0.2f), 1);
  check_color(seen("<shape type='cube'>" + wide, 9.95f, -0.2f), 0);
  for (const char* type : {"rectangle", "sphere", "disk"})
    check_color(seen(std::string("<shape type='") + type + "'>", 0, 0), 1);
  // A copy has the lines of the group, wherever it is and however large.
  const std::string instance =
      "</shape></shape><shape type='instance'><ref id='g'/><transform name='toWorld'><scale "
      "x='10' y='10'/><translate x='1'/></transform>";
  const std::string group = "<shape type='shapegroup' id='g'><shape type='cube'>" + lines;
  const auto copy = [&](float x, float y) {
    return TexturedScene("0.6.0", group + instance + "</shape>").albedo(x, y);
  };
  check_color(copy(10.5f, -2), 0);
  check_color(copy(7, -2), 1);
}
