// Surfaces that emit: samples follow their densities, and both agree with what rays find.
#include "lights/area.h"

#include <doctest/doctest.h>

#include <numbers>

#include "math/sampler.h"
#include "math/warp.h"
#include "support/lamp.h"
#include "support/statistics.h"
#include "textures/bitmap.h"

using namespace duet;
using test::analytic, test::fan, test::Lamp, test::mesh;

namespace {

/// Whether the density can be integrated over cells: at the silhouette of a curved surface that is
/// sampled by area it is infinite, and at the edges of a picture it jumps.
enum class Density { tame, wild };

void check_lamp(const Lamp& lamp, const Point3f& from, const std::string& name,
                Density density = Density::tame, int sub = 40) {
  INFO(name);
  const AreaLight& light = *lamp.light;
  const auto pdf = [&](const Vector3f& w) {
    float d2 = 0;
    const auto s = lamp.look(from, w, d2);
    // What does not shine towards the point is not sampled.
    if (!s || light.emitted(*s, -w).is_black()) return 0.0;
    return double(light.pdf_direct(from, *s, w, d2).value);
  };
  if (density == Density::tame) {
    const auto result = test::chi2_sphere(
        [&](float, Point2f v, Vector3f& d) {
          const auto s = light.sample_direct(from, v);
          if (!s) return false;
          d = s->wi;
          return true;
        },
        pdf, {.nx = 24, .ny = 16, .sub = sub, .samples = 100000, .level = 1e-3});
    CHECK_MESSAGE(result.pass, result.message);
  }
  // Both ways to estimate the light that arrives agree.
  Sampler sampler(SampleSequence::independent, 9, 0, 0);
  Moments by_light, by_direction;
  int slipped = 0;
  for (int i = 0; i < 200000; ++i) {
    sampler.start_sample(uint32_t(i));
    const Vector3f w = square_to_sphere(sampler.next_2d());
    float d2 = 0;
    const auto found = lamp.look(from, w, d2);
    by_direction.add(found ? 4 * std::numbers::pi * double(light.emitted(*found, -w).g) : 0.0);
    const auto s = light.sample_direct(from, sampler.next_2d());
    by_light.add(s ? double(s->weight.g) : 0.0);
    if (!s || i % 50) continue;
    // A ray to the target ends just before the light, on its own side.
    CHECK(length(s->wi) == doctest::Approx(1).epsilon(1e-5));
    const Vector3f d = s->target - from;
    CHECK(max_abs(normalize(d) - s->wi) < 1e-4f);
    CHECK_FALSE(lamp.accel->occluded({from, d, 0x1.fffep-1f}));
    const auto hit = lamp.look(from, s->wi, d2);
    if (!hit) continue;                            // at the rim
    if (light.emitted(*hit, -s->wi).is_black()) {  // through an edge between two faces
      ++slipped;
      continue;
    }
    CHECK(std::sqrt(d2) == doctest::Approx(length(d)).epsilon(1e-3));
    const Spectrum weight = light.emitted(*hit, -s->wi) / s->pdf.value;
    for (int k = 0; k < 3; ++k) CHECK(s->weight[k] == doctest::Approx(weight[k]).epsilon(0.02));
  }
  CHECK(slipped <= 2);
  CHECK(by_direction.mean() > 0);
  const double error = std::hypot(by_light.error(), by_direction.error());
  CHECK_MESSAGE(std::abs(by_light.mean() - by_direction.mean()) < 4 * error,
                by_light.mean() << " and " << by_direction.mean() << " ± " << error);
}

const ColorSlot kRadiance{{1, 2, 3}};

}  // namespace

TEST_CASE("area lights are sampled as their densities say") {
  const Matrix4 turn = Matrix4::rotate(35, 3, 1, 2);
  const Matrix4 skew = turn * Matrix4::scale(1.3, 0.6, 0.9) * Matrix4::rotate(25, 1, 1, 0);
  const Point3f above(0.3f, -0.2f, 1.4f);
  check_lamp(Lamp(mesh(fan(), turn), kRadiance), {0.4f, 0.3f, 1.1f}, "triangles");
  check_lamp(Lamp(mesh(make_rectangle(), skew), kRadiance), {0.5f, 0.9f, 1.2f}, "parallelogram");
  // One of its corners is a small part of a cell.
  check_lamp(Lamp(mesh(make_cube(), skew), kRadiance), {1.5f, 0.9f, 1.2f}, "box", Density::tame,
             150);
  check_lamp(Lamp(analytic(ShapeKind::sphere, turn), kRadiance), above, "sphere");
  check_lamp(Lamp(analytic(ShapeKind::sphere, turn), kRadiance), {0.2f, 0.3f, 0.95f},
             "sphere close by");
  check_lamp(Lamp(analytic(ShapeKind::sphere, turn * Matrix4::scale(-1, 1, 1), true), kRadiance),
             above, "sphere turned and flipped");
  check_lamp(Lamp(analytic(ShapeKind::sphere, turn, true), kRadiance), {0.3f, -0.4f, 0.2f},
             "sphere from within");
  check_lamp(Lamp(analytic(ShapeKind::sphere, skew), kRadiance), above, "ellipsoid", Density::wild);
  check_lamp(Lamp(analytic(ShapeKind::sphere, skew, true), kRadiance), {0.1f, -0.2f, 0.15f},
             "ellipsoid from within");
  check_lamp(Lamp(analytic(ShapeKind::disk, skew), kRadiance), {0.5f, 0.9f, 1.0f}, "disk");
  check_lamp(Lamp(analytic(ShapeKind::cylinder, skew), kRadiance), {-1.9f, 0.5f, 0.3f}, "cylinder",
             Density::wild);
  check_lamp(Lamp(analytic(ShapeKind::cylinder, turn, true), kRadiance), {0.2f, 0.3f, 0.4f},
             "cylinder from within");
}

TEST_CASE("textured area lights are sampled where they shine") {
  // A dim image with a bright spot.
  std::vector<float> pixels(size_t(32) * 32 * 3, 0.02f);
  for (int y = 20; y < 24; ++y)
    for (int x = 6; x < 10; ++x) pixels[size_t(y * 32 + x) * 3 + 1] = 50;
  const Bitmap image(std::make_shared<BitmapPixels>(32, 32, 3, pixels), TextureFilter::bilinear,
                     WrapMode::repeat, WrapMode::repeat, {});
  const ColorSlot slot{{}, &image};
  const Lamp screen(mesh(make_rectangle(), Matrix4::rotate(35, 3, 1, 2)), slot);
  const Point3f from(0.5f, 0.9f, 1.2f);
  check_lamp(screen, from, "rectangle", Density::wild);
  check_lamp(Lamp(mesh(make_cube(), Matrix4::rotate(35, 3, 1, 2)), slot), {1.5f, 0.9f, 1.2f}, "box",
             Density::wild);
  check_lamp(Lamp(analytic(ShapeKind::sphere, Matrix4{}), slot), {0.5f, 0.9f, 1.2f}, "sphere");
  check_lamp(Lamp(analytic(ShapeKind::disk, Matrix4{}), slot), {0.5f, 0.9f, 1.2f}, "disk");
  Sampler sampler(SampleSequence::independent, 9, 0, 0);
  Moments m;
  for (int i = 0; i < 20000; ++i) {
    sampler.start_sample(uint32_t(i));
    const auto s = screen.light->sample_direct(from, sampler.next_2d());
    m.add(s ? double(s->weight.g) : 0.0);
  }
  // By area alone the relative deviation would be about 8.
  CHECK(std::sqrt(m.variance()) < 0.5 * m.mean());
  // Mean radiance, times area, times π.
  CHECK(screen.light->power(1) ==
        doctest::Approx(4 * std::numbers::pi * double(image.average().luminance())).epsilon(0.02));
}

TEST_CASE("pictures of soft contrast are sampled as their densities say") {
  std::vector<float> pixels(size_t(8) * 8);
  for (size_t i = 0; i < pixels.size(); ++i) pixels[i] = 2 + std::sin(float(i) * 0.3f);
  const Bitmap image(std::make_shared<BitmapPixels>(8, 8, 1, pixels), TextureFilter::bilinear,
                     WrapMode::repeat, WrapMode::repeat, {});
  const ColorSlot slot{{}, &image};
  check_lamp(Lamp(mesh(make_rectangle(), Matrix4::rotate(35, 3, 1, 2)), slot), {0.5f, 0.9f, 1.2f},
             "rectangle");
  check_lamp(Lamp(mesh(make_cube(), Matrix4::rotate(35, 3, 1, 2)), slot), {1.5f, 1.5f, 1.2f},
             "box");
}

TEST_CASE("cells cover a mesh once, whatever it shows") {
  std::vector<float> pixels(64 * 64);
  for (size_t i = 0; i < pixels.size(); ++i) pixels[i] = float(i % 7) * float(i % 64 > 20);
  const Bitmap image(std::make_shared<BitmapPixels>(64, 64, 1, pixels), TextureFilter::bilinear,
                     WrapMode::repeat, WrapMode::repeat, {});
  TriangleMesh m = fan();
  m.uvs = {{0, 0}, {1, 0.1f}, {0.9f, 0.5f}, {0.2f, 1}, {0.1f, 0.4f}};
  Shape shape = mesh(m, Matrix4{});
  shape.needs.uv = true;
  const TriangleCells cells(shape, {{}, &image});
  // The density integrates to one over each triangle's share, and samples have it.
  double total = 0;
  for (uint32_t t = 0; t < 3; ++t) {
    const int n = 700;
    double sum = 0;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const Point2f b = square_to_triangle({(float(i) + 0.5f) / n, (float(j) + 0.5f) / n});
        sum += double(cells.pdf(t, b).value);
      }
    total += sum / (n * n) * double(triangle_area(*shape.mesh, t));
  }
  CHECK(total == doctest::Approx(1).epsilon(1e-3));
  Sampler sampler(SampleSequence::independent, 2, 0, 0);
  Moments area;
  int at_edges = 0;
  for (int i = 0; i < 50000; ++i) {
    sampler.start_sample(uint32_t(i));
    const ShapePoint p = cells.sample(sampler.next_2d());
    const float pdf = cells.pdf(p.primitive, p.barycentric).value;
    at_edges += std::abs(pdf - p.pdf.value) > 1e-3f * pdf;
    area.add(1 / double(p.pdf.value));
  }
  // Picking a cell leaves few bits for the position: some points lie on the very edge.
  CHECK(at_edges < 250);
  CHECK(std::abs(area.mean() - surface_area(shape)) < 4 * area.error());
}

TEST_CASE("light leaves on the side of the shading normal") {
  // Normals that disagree with the order of the vertices.
  TriangleMesh m = fan();
  m.normals.assign(5, {0, 0, -1});
  const Lamp lamp(mesh(m, Matrix4{}), kRadiance);
  CHECK_FALSE(lamp.light->sample_direct({0, 0.5f, 1}, {0.5f, 0.5f}));
  CHECK(lamp.light->sample_direct({0, 0.5f, -1}, {0.5f, 0.5f}));
  check_lamp(lamp, {0.4f, 0.3f, -1.1f}, "reversed normals");
  // And normals that lean over so far that grazing directions are on the wrong side.
  m.normals.assign(5, normalize(Normal3f(1, 0, 0.3f)));
  m.normals[4] = {0, 0, 1};
  check_lamp(Lamp(mesh(m, Matrix4{}), kRadiance), {-1.4f, 0.3f, 0.5f}, "leaning normals");
  check_lamp(Lamp(mesh(m, Matrix4{}), kRadiance, EmittingSide::geometric), {-1.4f, 0.3f, 0.5f},
             "leaning normals that do not matter");
  check_lamp(Lamp(mesh(m, Matrix4{}), kRadiance, EmittingSide::both), {-1.4f, 0.3f, 0.5f},
             "leaning normals and two sides");
  TriangleMesh rectangle = make_rectangle();
  rectangle.normals.assign(4, normalize(Normal3f(1, 0, 0.3f)));
  check_lamp(Lamp(mesh(rectangle, Matrix4{}), kRadiance), {-0.3f, 0.3f, 0.6f},
             "rectangle with leaning normals");
}

TEST_CASE("lights are sampled alike at all scales") {
  for (const double scale : {1e-3, 1.0, 1e6}) {
    const Matrix4 place = Matrix4::scale(scale, scale, scale);
    std::vector<Lamp> lamps;
    lamps.emplace_back(mesh(fan(), place), kRadiance);
    lamps.emplace_back(mesh(make_rectangle(), place), kRadiance);
    for (const ShapeKind kind : {ShapeKind::sphere, ShapeKind::disk, ShapeKind::cylinder})
      lamps.emplace_back(analytic(kind, place), kRadiance);
    for (const Lamp& lamp : lamps) {
      // Near and far; the weight is the solid angle times the radiance.
      for (const double d : {1.7, 1e3}) {
        const Point3f from(float(d * scale), float(0.1 * scale), float(d * scale));
        const auto s = lamp.light->sample_direct(from, {0.3f, 0.1f});
        if (!s) continue;
        CHECK(is_finite(s->weight));
        CHECK(double(s->weight.r) * d * d == doctest::Approx(4).epsilon(0.99));
        CHECK_FALSE(lamp.accel->occluded({from, s->target - from, 0x1.fffep-1f}));
        CHECK(double(lamp.light->power(1)) / (scale * scale) ==
              doctest::Approx(14 * 2).epsilon(0.99));
      }
    }
  }
}

TEST_CASE("small, distant spheres keep their solid angle") {
  const Lamp lamp(analytic(ShapeKind::sphere, Matrix4{}), kRadiance);
  for (const float d : {1.001f, 2.0f, 100.0f, 1e4f, 1e6f}) {
    const double sine = 1 / double(d);
    const double solid_angle =
        2 * std::numbers::pi * sine * sine / (1 + std::sqrt(1 - sine * sine));
    for (int i = 0; i < 16; ++i) {
      const auto s = lamp.light->sample_direct({0, 0, d}, {float(i % 4) / 4, float(i) / 16});
      REQUIRE(s);
      CHECK(double(s->weight.r) == doctest::Approx(solid_angle).epsilon(1e-3));
      CHECK(length(s->wi) == doctest::Approx(1).epsilon(1e-6));
    }
  }
}
