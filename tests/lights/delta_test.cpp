// Lights without extent against Mitsuba's.
#include "lights/delta.h"

#include <doctest/doctest.h>

#include "math/angles.h"
#include "math/fov.h"
#include "math/sampler.h"
#include "math/warp.h"
#include "support/tables.h"
#include "textures/bitmap.h"

using namespace duet;

namespace {

std::unique_ptr<Texture> to_image(const test::Json& t) {
  const int w = t["width"], h = t["height"];
  return std::make_unique<Bitmap>(
      std::make_shared<BitmapPixels>(w, h, 3, t["pixels"].get<std::vector<float>>()),
      TextureFilter::bilinear, WrapMode::repeat, WrapMode::repeat, UvTransform{});
}

Spectrum color(const test::Json& p, const char* name) {
  return p.contains(name) ? test::triple<Spectrum>(p[name], 0) : Spectrum(1);
}

std::unique_ptr<Light> to_light(const test::Json& c, const Texture* image) {
  const std::string kind = c["kind"];
  const test::Json& p = c["parameters"];
  const Transform to_world(test::to_matrix(c["to_world"]));
  if (!c["textured"]) image = nullptr;
  if (kind == "point")
    return std::make_unique<PointEmitter>(to_world(Point3f(0, 0, 0)), color(p, "intensity"));
  if (kind == "directional")
    return std::make_unique<DirectionalEmitter>(to_world, color(p, "irradiance"));
  if (kind == "spot") {
    const double cutoff = p.value("cutoff_angle", 20.0);
    return std::make_unique<SpotEmitter>(to_world, color(p, "intensity"), cutoff * kRadians,
                                         p.value("beam_width", 0.75 * cutoff) * kRadians, image);
  }
  const ColorSlot slot{color(p, "irradiance"), image};
  const Point2i size = image ? image->resolution() : Point2i{1, 1};
  const double aspect = double(size.x) / double(size.y);
  const std::string axis = p.value("fov_axis", "x");
  const FovAxis fov_axis = axis == "y"          ? FovAxis::y
                           : axis == "diagonal" ? FovAxis::diagonal
                           : axis == "smaller"  ? FovAxis::smaller
                           : axis == "larger"   ? FovAxis::larger
                                                : FovAxis::x;
  return std::make_unique<ProjectorEmitter>(to_world, slot, p.value("scale", 1.0f),
                                            horizontal_fov(p["fov"], fov_axis, aspect), aspect);
}

}  // namespace

TEST_CASE("delta lights send what Mitsuba's send") {
  const test::Json table = test::read_table("lights");
  const auto image = to_image(table["image"]);
  int lit = 0;
  for (const test::Json& c : table["delta"]) {
    const auto light = to_light(c, image.get());
    CHECK(is_delta(light->kind()));
    for (const test::Json& row : c["samples"]) {
      INFO(c["kind"].dump() << c["parameters"].dump() << row.dump());
      const Point3f from = test::triple<Point3f>(row, 0);
      const Spectrum weight = test::triple<Spectrum>(row, 7);
      const auto s = light->sample_direct(from, {});
      if (!s) {
        CHECK(weight.is_black());
        continue;
      }
      ++lit;
      for (int k = 0; k < 3; ++k)
        CHECK(std::abs(s->weight[k] -
                       weight[k] * (s->finite ? 1.0f : length(test::triple<Vector3f>(row, 3)))) <
              2e-4f * weight[k] + 1e-6f);
      const Vector3f d = test::triple<Vector3f>(row, 3);
      CHECK(max_abs(s->wi - normalize(d)) < 1e-6f);
      CHECK(s->delta);
      CHECK(s->pdf.value == 0);
      CHECK(s->finite == !is_infinite(light->kind()));
      if (s->finite) {
        CHECK(distance(from, s->target) == doctest::Approx(row[6].get<float>()).epsilon(1e-5));
        CHECK(max_abs(normalize(s->target - from) - s->wi) < 1e-5f);
      }
    }
  }
  CHECK(lit > 150);
}

TEST_CASE("the power of a light at a point is the integral of what it sends") {
  const test::Json table = test::read_table("lights");
  const auto image = to_image(table["image"]);
  const Matrix4 place = Matrix4::translate(1, -2, 3) * Matrix4::rotate(70, 1, 2, 3);
  const Transform to_world(place);
  const Point3f center = to_world(Point3f(0, 0, 0));
  const Spectrum rgb(1, 2, 3);
  std::vector<std::unique_ptr<Light>> lights;
  lights.push_back(std::make_unique<PointEmitter>(center, rgb));
  lights.push_back(
      std::make_unique<SpotEmitter>(to_world, rgb, 50 * kRadians, 20 * kRadians, nullptr));
  lights.push_back(
      std::make_unique<SpotEmitter>(to_world, rgb, 35 * kRadians, 35 * kRadians, nullptr));
  for (const SpotFalloff falloff : {SpotFalloff::smooth, SpotFalloff::quartic})
    lights.push_back(std::make_unique<SpotEmitter>(to_world, rgb, 50 * kRadians, 20 * kRadians,
                                                   nullptr, falloff));
  lights.push_back(std::make_unique<ProjectorEmitter>(to_world, ColorSlot{rgb}, 2.0f, 60, 1.5));
  for (const auto& light : lights) {
    Sampler sampler(SampleSequence::sobol, 1, 0, 0);
    double sum = 0;
    const int n = 1 << 18;
    for (int i = 0; i < n; ++i) {
      sampler.start_sample(uint32_t(i));
      const auto s = light->sample_direct(center + square_to_sphere(sampler.next_2d()), {});
      if (s) sum += double(s->weight.luminance());
    }
    CHECK(light->power(1e9) == doctest::Approx(sum / n * 4 * 3.14159265).epsilon(5e-3));
  }
  const DirectionalEmitter sun(to_world, rgb);
  CHECK(sun.power(3) == doctest::Approx(9 * 3.14159265 * double(rgb.luminance())));
}

TEST_CASE("a narrow spot fades evenly") {
  const SpotEmitter light(Transform{}, Spectrum(1), 0.1 * kRadians, 0, nullptr);
  for (int i = 1; i < 10; ++i) {
    const double angle = 0.01 * i * kRadians;
    const auto s =
        light.sample_direct({float(100 * std::sin(angle)), 0, float(100 * std::cos(angle))}, {});
    REQUIRE(s);
    CHECK(s->weight.r * 1e4f == doctest::Approx(1 - 0.1 * i).epsilon(1e-3));
  }
  CHECK_FALSE(light.sample_direct({1, 0, 100}, {}));
  CHECK_FALSE(light.sample_direct({0, 0, 0}, {}));
}
