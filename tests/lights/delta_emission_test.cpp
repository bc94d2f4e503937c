// Rays that start at lights without extent.
#include <doctest/doctest.h>

#include <numbers>

#include "lights/delta.h"
#include "math/angles.h"
#include "math/sampler.h"
#include "math/warp.h"
#include "support/flux.h"
#include "support/statistics.h"
#include "textures/bitmap.h"

using namespace duet;
using test::Probe;

namespace {

const Spectrum kRgb(1, 2, 3);

/// Has no black, which would leave gaps in what light samples say about densities.
const Bitmap& picture() {
  static const Bitmap image = [] {
    std::vector<float> pixels(6 * 4 * 3);
    for (size_t i = 0; i < pixels.size(); ++i) pixels[i] = 0.2f + float(i * i % 7);
    return Bitmap(std::make_shared<BitmapPixels>(6, 4, 3, pixels), TextureFilter::bilinear,
                  WrapMode::repeat, WrapMode::repeat, {});
  }();
  return image;
}

Matrix4 place() {
  return Matrix4::translate(1, -2, 3) * Matrix4::rotate(70, 1, 2, 3);
}

/// A transform that keeps neither lengths nor angles nor handedness.
Matrix4 sheared() {
  Matrix4 shear;
  shear[0][2] = 0.3, shear[1][0] = 0.4, shear[2][1] = -0.2;
  return place() * shear * Matrix4::scale(-1.3, 0.7, 0.9);
}

/// What goes for all lights at a point, at `position`. `axis` points to where light is.
void check_position(const Light& light, const Point3f& position, const Vector3f& axis,
                    const std::string& name) {
  INFO(name);
  const auto pdf = [&](const Vector3f& w) {
    const auto s = light.sample_direct(position + w * 2, {});
    return s ? double(s->emission) : 0.0;
  };
  const auto result = test::chi2_sphere(
      [&](float u, Point2f v, Vector3f& d) {
        const auto e = light.sample_emission({u, u}, v);
        if (e) d = e->ray.direction;
        return e.has_value();
      },
      pdf, {.nx = 16, .ny = 10, .sub = 100, .samples = 50000, .level = 1e-3});
  CHECK_MESSAGE(result.pass, result.message);
  Sampler sampler(SampleSequence::independent, 3, 0, 0);
  int empty = 0, wrong = 0;
  Moments solid_angle, reached;
  for (int i = 0; i < 20000; ++i) {
    sampler.start_sample(uint32_t(i));
    const Point2f u = sampler.next_2d(), v = sampler.next_2d();
    reached.add(pdf(square_to_sphere(u)) > 0 ? 4 * std::numbers::pi : 0);
    const auto e = light.sample_emission(u, v);
    solid_angle.add(e ? 1 / double(e->density) : 0);
    if (!e) {
      ++empty;
      continue;
    }
    CHECK(e->ray.origin == position);
    CHECK(std::abs(length(e->ray.direction) - 1) < 1e-5f);
    CHECK(e->ray.tmax == INFINITY);
    const float t = 0.5f + 4 * sampler.next_1d();
    const Point3f at = e->ray.origin + e->ray.direction * t;
    CHECK(light.direct_density(*e, at) == doctest::Approx(t * t).epsilon(1e-4));
    const auto s = light.sample_direct(at, {});
    if (!s) {
      ++wrong;  // the rim
      continue;
    }
    CHECK(max_abs(s->wi + e->ray.direction) < 1e-5f);
    CHECK(s->emission == doctest::Approx(e->density).epsilon(1e-4));
    for (int k = 0; k < 3; ++k)
      wrong +=
          std::abs(s->weight[k] * t * t - e->weight[k] * e->density) > 1e-3f * s->weight[k] * t * t;
  }
  // Where the intensity falls to nothing, its digits do so before.
  CHECK(wrong < 100);
  CHECK(empty < 20);
  CHECK(std::abs(solid_angle.mean() - reached.mean()) <
        4 * std::hypot(solid_angle.error(), reached.error()) + 1e-5 * reached.mean());
  const Point3f ahead = position + normalize(axis) * 1.5f;
  test::check_flux(light, {ahead, -axis, 0.5f}, name);
  test::check_flux(light, {ahead, Vector3f(0.3f, 0.2f, 0.1f) - normalize(axis), 1.2f}, name);
}

void check_spot(const Matrix4& to_world, double cutoff, double beam_width, const Texture* texture,
                const std::string& name) {
  const Transform t(to_world);
  check_position(SpotEmitter(t, kRgb, cutoff * kRadians, beam_width * kRadians, texture),
                 t(Point3f(0, 0, 0)), t(Vector3f(0, 0, 1)), name);
}

void check_projector(const Matrix4& to_world, const ColorSlot& irradiance, double fov,
                     const std::string& name) {
  const Transform t(to_world);
  check_position(ProjectorEmitter(t, irradiance, 2, fov, 1.5), t(Point3f(0, 0, 0)),
                 t(Vector3f(0, 0, 1)), name);
}

}  // namespace

TEST_CASE("point lights emit the light that points find") {
  check_position(PointEmitter({1, -2, 3}, kRgb), {1, -2, 3}, {0.3f, -1, 0.4f}, "point");
}

TEST_CASE("spot lights emit the light that points find") {
  check_spot(place(), 40, 30, nullptr, "spot");
  check_spot(place(), 40, 40, nullptr, "spot that does not fade");
  check_spot(place(), 60, 20, &picture(), "spot with a texture");
  check_spot(sheared(), 35, 20, nullptr, "sheared spot");
  check_spot(sheared(), 50, 40, &picture(), "sheared spot with a texture");
}

TEST_CASE("projectors emit the light that points find") {
  check_projector(place(), ColorSlot{kRgb}, 70, "projector");
  check_projector(place(), ColorSlot{{}, &picture()}, 60, "projector with an image");
  check_projector(sheared(), ColorSlot{{}, &picture()}, 60, "sheared projector");
}

TEST_CASE("a projector never sends negative light") {
  Matrix4 shear;
  shear[0][2] = 2;
  const ProjectorEmitter light(Transform(shear), ColorSlot{kRgb}, 1, 150, 1);
  Sampler sampler(SampleSequence::independent, 3, 0, 0);
  int empty = 0;
  for (int i = 0; i < 1000; ++i) {
    sampler.start_sample(uint32_t(i));
    const auto e = light.sample_emission({0, 0}, sampler.next_2d());
    empty += !e;
    if (e) CHECK(e->weight.r > 0);
    const auto s = light.sample_direct(Point3f(square_to_sphere(sampler.next_2d())), {});
    if (s) CHECK(s->weight.r > 0);
  }
  CHECK(empty > 0);
}

TEST_CASE("narrow spots keep their density") {
  for (const double degrees : {1.0, 0.01, 1e-4}) {
    const SpotEmitter light(Transform{}, kRgb, degrees * kRadians, 0, nullptr);
    const double solid_angle = std::numbers::pi * std::pow(degrees * kRadians, 2);
    for (int i = 0; i < 16; ++i) {
      const auto e = light.sample_emission({}, {(float(i / 4) + 0.5f) / 4, float(i % 4) / 4});
      REQUIRE(e);
      CHECK(double(e->density) * solid_angle == doctest::Approx(1).epsilon(1e-3));
    }
  }
}

TEST_CASE("parallel light is emitted through the whole scene") {
  DirectionalEmitter light(Transform(sheared()), kRgb);
  const Point3f center(2, -1, 5);
  const float radius = 3;
  light.surround(center, radius);
  const auto s = light.sample_direct(center, {});
  REQUIRE(s);
  Sampler sampler(SampleSequence::independent, 3, 0, 0);
  double furthest = 0;
  for (int i = 0; i < 5000; ++i) {
    sampler.start_sample(uint32_t(i));
    const auto e = light.sample_emission(sampler.next_2d(), sampler.next_2d());
    REQUIRE(e);
    CHECK(e->ray.direction == -s->wi);
    CHECK(distance(e->ray.origin, center) > radius);
    CHECK(dot(center - e->ray.origin, e->ray.direction) > radius);
    CHECK(e->density == s->emission);
    CHECK(1 / double(e->density) ==
          doctest::Approx(std::numbers::pi * radius * radius).epsilon(0.01));
    CHECK(e->weight.g * e->density == doctest::Approx(s->weight.g));
    CHECK(light.direct_density(*e, center) == 1);
    furthest = std::max(furthest, double(length(cross(e->ray.origin - center, s->wi))));
  }
  CHECK(furthest == doctest::Approx(radius).epsilon(0.01));
  test::check_flux(light, {center, s->wi, 2.5f}, "across");
  test::check_flux(light, {center + Vector3f(1, 0, -1), s->wi + Vector3f(0.5f, 0.6f, 0), 1.4f},
                   "aslant");
  CHECK_FALSE(DirectionalEmitter(Transform{}, Spectrum(0)).sample_emission({}, {}));
}

TEST_CASE("spot lights that fade by the cosine emit the light that points find") {
  for (const SpotFalloff falloff : {SpotFalloff::smooth, SpotFalloff::quartic}) {
    for (const Matrix4& m : {place(), sheared()}) {
      const Transform t(m);
      check_position(SpotEmitter(t, kRgb, 40 * kRadians, 20 * kRadians, nullptr, falloff),
                     t(Point3f(0, 0, 0)), t(Vector3f(0, 0, 1)),
                     std::string(kSpotFalloffs[size_t(falloff)]));
    }
    // Halfway between the cosines.
    const SpotEmitter spot(Transform(), Spectrum(1.0f), 60 * kRadians, 0, nullptr, falloff);
    const float cosine = 0.75f;
    const auto s = spot.sample_direct(Point3f(std::sqrt(1 - cosine * cosine), 0, cosine), {});
    REQUIRE(s.has_value());
    CHECK(double(s->weight.r) ==
          doctest::Approx(falloff == SpotFalloff::smooth ? 0.5 : 0.0625).epsilon(1e-4));
  }
}

TEST_CASE("projectors of intensity, and goniometric lights, emit the light that points find") {
  const Transform t(place());
  check_position(ProjectorEmitter(t, ColorSlot{kRgb, nullptr}, 2, 50, 1.5, true),
                 t(Point3f(0, 0, 0)), t(Vector3f(0, 0, 1)), "projector of intensity");
  std::vector<Spectrum> texels;
  for (int i = 0; i < 64; ++i) texels.push_back(kRgb * (0.25f + float(i % 5)));
  for (const Matrix4& m : {place(), sheared()}) {
    const Transform to_world(m);
    check_position(GoniometricEmitter(to_world, 8, texels), to_world(Point3f(0, 0, 0)),
                   to_world(Vector3f(0, 0, 1)), "goniometric");
  }
}
