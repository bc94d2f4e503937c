// Sun and sky, held against Mitsuba 3.9.1.
#include "lights/sky.h"

#include <doctest/doctest.h>

#include "math/sampler.h"
#include "math/warp.h"
#include "support/flux.h"
#include "support/statistics.h"

using namespace duet;

namespace {

SkyOptions evening() {
  SkyOptions o;
  o.turbidity = 3.4;
  o.albedo = Spectrum(0.1f, 0.4f, 0.9f);
  o.sun = {0.3f, 0.4f, 0.6f};
  return o;
}

void check_radiance(const Sky& sky, const Vector3f& w, const Spectrum& expected,
                    double tolerance = 2e-4) {
  const Spectrum found = sky.emitted({}, normalize(w));
  INFO(w.x << " " << w.y << " " << w.z);
  for (int k = 0; k < 3; ++k) CHECK(found[k] == doctest::Approx(expected[k]).epsilon(tolerance));
}

void check_sampling(Sky& sky, const std::string& name) {
  INFO(name);
  sky.surround({1, 2, 3}, 4);
  const auto result = test::chi2_sphere(
      [&](float, Point2f v, Vector3f& d) {
        const auto s = sky.sample_direct({}, v);
        if (s) d = s->wi;
        return s.has_value();
      },
      [&](const Vector3f& d) { return double(sky.pdf_direct({}, d).value); },
      {.nx = 36, .ny = 24, .sub = 24, .samples = 100000});
  CHECK_MESSAGE(result.pass, result.message);
  Sampler sampler(SampleSequence::sobol, 5, 0, 0);
  double power = 0, sampled = 0, mass = 0;
  const int n = 1 << 16;
  for (int i = 0; i < n; ++i) {
    sampler.start_sample(uint32_t(i));
    const Point2f u = sampler.next_2d();
    const Vector3f w = square_to_sphere(u);
    power += double(sky.emitted({}, w).luminance()) * 4 * 3.14159265 / n;
    mass += double(sky.pdf_direct({}, w).value) * 4 * 3.14159265 / n;
    const auto s = sky.sample_direct({}, u);
    if (!s) continue;
    sampled += double(s->weight.luminance()) / n;
    if (i % 16) continue;
    CHECK(length(s->wi) == doctest::Approx(1).epsilon(1e-5));
    CHECK(s->pdf.value == doctest::Approx(sky.pdf_direct({}, s->wi).value).epsilon(2e-3));
    const auto e = sky.sample_emission({0.2f, 0.7f}, u);
    REQUIRE(e);
    CHECK(e->ray.direction == -s->wi);
    CHECK(e->density == s->emission);
  }
  CHECK(mass == doctest::Approx(1).epsilon(0.02));
  CHECK(sampled == doctest::Approx(power).epsilon(0.02));
  CHECK(sky.power(2) == doctest::Approx(power * 3.14159265 * 4).epsilon(0.02));
}

}  // namespace

TEST_CASE("the sky has the colours of Mitsuba's") {
  const Sky sky(evening(), Matrix4{});
  check_radiance(sky, {0, 0, 1}, {0.02825996f, 0.05154014f, 0.12338786f});
  check_radiance(sky, {1, 0, 0.01f}, {0.13989457f, 0.21322395f, 0.32473204f});
  check_radiance(sky, {0.3f, 0.41f, 0.6f}, {0.21042448f, 0.25007245f, 0.29899427f});
  check_radiance(sky, {-0.5f, 0.5f, 0.2f}, {0.06010666f, 0.12515256f, 0.27430743f});
  check_radiance(sky, {0.9f, -0.3f, 1.2f}, {0.03576040f, 0.06690228f, 0.15339264f});
  CHECK(sky.emitted({}, {0, 0, -1}).is_black());
  SkyOptions low;
  low.sun = {1, 0, 0.02f};
  check_radiance(Sky(low, Matrix4{}), {1, 0, 0.2f}, {0.12361535f, 0.06982320f, 0.02685385f});
  low.turbidity = 1, low.albedo = Spectrum(0.0f), low.sun = {1, 0, 0}, low.sun_scale = 0;
  const Sky clear(low, Matrix4{});
  for (int i = 0; i < 100; ++i) {
    const float angle = 3.14159265f * float(i) / 100;
    CHECK(clear.emitted({}, {std::cos(angle), std::sin(angle), 1e-3f}).b >= 0);
  }
  low = {};
  low.sun = {1, 0, 0.02f};
  low.turbidity = 9.5;
  check_radiance(Sky(low, Matrix4{}), {0, 1, 0.2f}, {0.01208934f, 0.01093312f, 0.00879221f});
}

TEST_CASE("the sun has the brightness of Mitsuba's, whatever its size") {
  SkyOptions o = evening();
  // Mitsuba's cosine of so small an angle is good to three digits.
  check_radiance(Sky(o, Matrix4{}), o.sun, {21307.531f, 17624.545f, 13244.684f}, 3e-3);
  o.sun_aperture = 3;
  o.sun_scale = 2;
  o.sky_scale = 0.5;
  check_radiance(Sky(o, Matrix4{}), o.sun, {1356.5980f, 1122.1447f, 843.32917f}, 5e-4);
}

TEST_CASE("a disk of given irradiance shines where it is, below the horizon as well") {
  SkyOptions o = evening();
  o.sky_scale = 0;
  o.sun_aperture = 10;
  o.sun_scale = 2;
  o.disk = {normalize(Vector3f(1, 0, 0.02f)), {1, 2, 3}};
  Sky sky(o, Matrix4{});
  const double solid_angle = 4 * 3.14159265 * std::pow(std::sin(2.5 * 3.14159265 / 180), 2);
  for (const float z : {-0.06f, 0.02f, 0.1f})
    check_radiance(sky, {1, 0, z}, Spectrum(1, 2, 3) * float(2 / solid_angle));
  CHECK(sky.emitted({}, normalize(Vector3f(1, 0, -0.08f))).is_black());
  CHECK(sky.emitted({}, normalize(Vector3f(0.3f, 0.4f, 0.6f))).is_black());
  // A small disk's edge is too sharp for the fields of the test.
  o.sky_scale = 1;
  o.sun_aperture = 40;
  Sky both(o, Matrix4{});
  check_sampling(both, "sky and a sun that the horizon would cut");
}

TEST_CASE("the sky turns with its transform, and a sun below the horizon leaves it dark") {
  const Matrix4 turn = Matrix4::rotate(40, 1, 2, 3) * Matrix4::scale(-1, 1, 1);
  const Sky plain(evening(), Matrix4{}), turned(evening(), turn);
  for (const Vector3f w : {Vector3f(0, 0, 1), {0.6f, 0, 0.8f}, {0, -0.8f, 0.6f}}) {
    const Spectrum a = plain.emitted({}, w), b = turned.emitted({}, Transform(turn)(w));
    for (int k = 0; k < 3; ++k) CHECK(a[k] == doctest::Approx(b[k]).epsilon(1e-4));
  }
  SkyOptions night;
  night.sun = {1, 0, -0.1f};
  const Sky dark(night, Matrix4{});
  CHECK(dark.emitted({}, {0, 0, 1}).is_black());
  CHECK(dark.power(1) == 0);
  CHECK_FALSE(dark.sample_direct({}, {0.3f, 0.4f}));
}

TEST_CASE("a stretched sky reaches below the horizon, an extended one fades there") {
  SkyOptions o = evening();
  o.stretch = 1.5;
  const Sky stretched(o, Matrix4{});
  CHECK(stretched.emitted({}, normalize(Vector3f(1, 0, -0.5f))).b > 0.1f);
  CHECK(stretched.emitted({}, {0, 0, -1}).is_black());
  o.stretch = 1;
  o.extend = true;
  const Sky extended(o, Matrix4{});
  const float at = extended.emitted({}, normalize(Vector3f(1, 0, -1e-3f))).g;
  // The fade is a half, smoothly from one, where the angle to the zenith is three quarters of π.
  CHECK(extended.emitted({}, normalize(Vector3f(1, 0, -1))).g ==
        doctest::Approx(0.5f * at).epsilon(0.02));
}

TEST_CASE("skies are sampled as their densities say") {
  SkyOptions o = evening();
  o.sun_scale = 0;
  Sky sky(o, Matrix4::rotate(50, 1, 2, 3));
  check_sampling(sky, "sky");
  o.sun_scale = 1;
  o.sun_aperture = 20;
  Sky both(o, Matrix4{});
  check_sampling(both, "sky and a large sun");
  o.sun_scale = 0;
  o.stretch = 4.0 / 3;  // to where the cosine is −1/2, an edge of the test's fields
  Sky stretched(o, Matrix4{});
  check_sampling(stretched, "stretched");
  o.stretch = 1;
  o.extend = true;
  Sky extended(o, Matrix4{});
  check_sampling(extended, "extended");
}
