// Rays that start at lights around the scene.
#include <doctest/doctest.h>

#include <numbers>

#include "lights/environment.h"
#include "math/sampler.h"
#include "math/warp.h"
#include "support/flux.h"
#include "support/statistics.h"

using namespace duet;
using test::Probe;

namespace {

const Point3f kSkyCenter(2, -1, 5);
constexpr float kSkyRadius = 3;

/// A sky with a sun, turned and mirrored.
EnvironmentMap make_map() {
  std::vector<Spectrum> texels;
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 16; ++x) {
      const float v = 1 + float((x * 7 + y * 3) % 5) + (x == 5 && y == 3 ? 40.0f : 0.0f);
      texels.emplace_back(v, 0.5f * v, 0.2f * v + 0.01f * float(x % 2));
    }
  return {16, 9, texels, Matrix4::rotate(50, 1, 2, 3) * Matrix4::scale(-2, 2, 2)};
}

void check_environment(EnvironmentLight& light, double tolerance, const std::string& name) {
  INFO(name);
  light.surround(kSkyCenter, kSkyRadius);
  const auto result = test::chi2_sphere(
      [&](float u, Point2f v, Vector3f& d) {
        const auto e = light.sample_emission({u, 0.3f}, v);
        if (e) d = -e->ray.direction;
        return e.has_value();
      },
      [&](const Vector3f& d) { return double(light.pdf_direct(kSkyCenter, d).value); },
      {.nx = 36, .ny = 24, .sub = 16, .samples = 100000});
  CHECK_MESSAGE(result.pass, result.message);
  Sampler sampler(SampleSequence::independent, 3, 0, 0);
  Moments measure, square;
  for (int i = 0; i < 20000; ++i) {
    sampler.start_sample(uint32_t(i));
    const Point2f position = sampler.next_2d(), direction = sampler.next_2d();
    const auto e = light.sample_emission(position, direction);
    REQUIRE(e);
    const Vector3f wi = -e->ray.direction;
    CHECK(e->ray.tmax == INFINITY);
    CHECK(std::abs(length(wi) - 1) < 1e-5f);
    const Vector3f start = e->ray.origin - kSkyCenter;
    CHECK(dot(start, wi) > kSkyRadius);
    CHECK(e->density == doctest::Approx(light.emission_density(wi)).epsilon(tolerance));
    CHECK(light.direct_density(*e, kSkyCenter) == light.pdf_direct(kSkyCenter, wi).value);
    for (int k = 0; k < 3; ++k)
      CHECK(e->weight[k] * e->density ==
            doctest::Approx(light.emitted(kSkyCenter, wi)[k]).epsilon(2 * tolerance));
    // A light sample from the same numbers is the same path.
    const auto s = light.sample_direct(kSkyCenter, direction);
    REQUIRE(s);
    CHECK(s->wi == wi);
    CHECK(s->emission == e->density);
    measure.add(1 / double(e->density));
    square.add(double(length_squared(cross(start, wi))));
  }
  const double disk = std::numbers::pi * sqr(kSkyRadius);
  CHECK(std::abs(measure.mean() - 4 * std::numbers::pi * disk) <
        4 * measure.error() + 0.003 * measure.mean());
  CHECK(square.mean() == doctest::Approx(0.5 * sqr(kSkyRadius)).epsilon(0.02));
  test::check_flux(light, {kSkyCenter, {1, 2, 0.5f}, 1.5f}, name);
  test::check_flux(light, {kSkyCenter, {-1, 0.3f, 0.5f}, 1.5f}, name);
  test::check_flux(light, {kSkyCenter + Vector3f(1.5f, 1.2f, -1), {0, -1, 0.2f}, 0.8f}, name);
}

}  // namespace

TEST_CASE("environments emit the light that points find") {
  ConstantEnvironment constant(Spectrum(1, 2, 3));
  check_environment(constant, 1e-6, "constant");
  EnvironmentMap map = make_map();
  check_environment(map, 2e-3, "map");
  std::vector<std::unique_ptr<EnvironmentLight>> parts;
  parts.push_back(std::make_unique<ConstantEnvironment>(Spectrum(1, 2, 3)));
  parts.push_back(std::make_unique<EnvironmentMap>(make_map()));
  const Vector3f w = normalize(Vector3f(1, 2, -1));
  const Spectrum radiance = parts[0]->emitted({}, w) + parts[1]->emitted({}, w);
  const double power = parts[0]->power(3) + parts[1]->power(3);
  EnvironmentSum sum(std::move(parts));
  CHECK(sum.emitted({}, w) == radiance);
  CHECK(sum.power(3) == doctest::Approx(power));
  check_environment(sum, 2e-3, "sum");
}

TEST_CASE("black environments emit no rays") {
  CHECK_FALSE(ConstantEnvironment(Spectrum(0)).sample_emission({0.2f, 0.3f}, {0.4f, 0.5f}));
  const EnvironmentMap map(4, 3, std::vector<Spectrum>(12), Matrix4{});
  CHECK_FALSE(map.sample_emission({0.2f, 0.3f}, {0.4f, 0.5f}));
}

TEST_CASE("rays into scenes of all sizes start outside and are finite") {
  for (const float radius : {0.0f, 1e-6f, 1.0f, 1e6f})
    for (const float away : {0.0f, 1.0f, 1e6f}) {
      ConstantEnvironment light(Spectrum(1));
      const Point3f center(away, 0, -away);
      light.surround(center, radius);
      for (int i = 0; i < 64; ++i) {
        const auto e = light.sample_emission({float(i % 8) / 8, float(i / 8) / 8},
                                             {float(i / 8) / 8, float(i % 8) / 8});
        REQUIRE(e);
        CHECK(is_finite(e->ray.origin));
        CHECK(is_finite(e->weight));
        CHECK(e->weight.r > 0);
        CHECK(std::isfinite(e->density));
        CHECK(distance(e->ray.origin, center) >= radius);
      }
    }
}
