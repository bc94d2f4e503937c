// Sensors that measure, against numbers of Mitsuba 3.9.1 and of geometry.
#include "cameras/meters.h"

#include <doctest/doctest.h>

#include "cameras/orthographic.h"
#include "cameras/spherical.h"
#include "math/sampler.h"
#include "math/warp.h"
#include "support/transport_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

std::string film(int width) {
  return "<film type='hdrfilm'><integer name='width' value='" + std::to_string(width) +
         "'/><integer name='height' value='1'/><rfilter type='box'/></film>";
}

/// A ball of radius 1/2 under a sky, seen by a sensor.
std::string ball(const std::string& sensor) {
  return sensor +
         "<integrator type='path'><integer name='max_depth' value='4'/></integrator><emitter "
         "type='constant'><rgb name='radiance' value='1 2 3'/></emitter>" +
         sphere_xml("0,0,0", "0.5",
                    "<bsdf type='diffuse'><rgb name='reflectance' value='.2 .5 .8'/></bsdf>");
}

void check_pixels(const std::string& content, const std::vector<Spectrum>& expected,
                  double tolerance, const std::string& method = "path", int spp = 8192) {
  INFO(content);
  INFO(method);
  const TransportScene scene(content);
  const RenderResult r = scene.render(method, {}, spp, 3);
  REQUIRE(r.image.data.size() == 4 * expected.size());
  for (size_t i = 0; i < expected.size(); ++i)
    for (int k = 0; k < 3; ++k)
      CHECK(r.image.data[4 * i + size_t(k)] == doctest::Approx(expected[i][k]).epsilon(tolerance));
}

const std::string kDown = "<vector name='direction' value='0 0 -1'/>";
const std::string kUnder =
    "<shape type='rectangle'><transform name='to_world'><rotate y='1' angle='180'/><translate "
    "z='2'/></transform>";

}  // namespace

TEST_CASE("meters measure what Mitsuba's do") {
  check_pixels(ball("<sensor type='radiancemeter'><point name='origin' value='0 0 3'/>" + kDown +
                    film(1) + "</sensor>"),
               {{0.2f, 1.0f, 2.4f}}, 0.01);
  check_pixels(ball("<sensor type='distant'>" + kDown + film(1) + "</sensor>"),
               {{0.73378f, 1.66866f, 2.80463f}}, 0.01);
  check_pixels(ball("<sensor type='distant'>" + kDown + "<point name='target' value='0 0 0'/>" +
                    film(1) + "</sensor>"),
               {{0.2f, 1.0f, 2.4f}}, 0.01);
  const std::string slanted = "<sensor type='distant'><vector name='direction' value='0 1 -1'/>";
  check_pixels(ball(slanted + "<shape name='target' type='rectangle'/>" + film(1) + "</sensor>"),
               {{0.77407f, 1.71812f, 2.83216f}}, 0.01);
  check_pixels(ball(slanted + "<shape name='target' type='sphere'/>" + film(1) + "</sensor>"),
               {{0.89015f, 1.86238f, 2.91669f}}, 0.01);
  check_pixels(ball("<sensor type='distant'><transform name='to_world'><scale value='2'/>"
                    "</transform>" +
                    film(1) + "</sensor>"),
               {{0.93437f, 1.91796f, 2.95076f}}, 0.01);
  for (const int width : {1, 2})
    check_pixels(
        ball(kUnder + "<sensor type='irradiancemeter'>" + film(width) + "</sensor></shape>"),
        std::vector<Spectrum>(size_t(width), Spectrum(3.0110f, 6.1042f, 9.2806f)), 0.005);
}

TEST_CASE("methods that cannot reach a meter do without") {
  const std::string irradiance =
      ball(kUnder + "<sensor type='irradiancemeter'>" + film(1) + "</sensor></shape>");
  for (const char* method : {"bdpt", "vcm"})
    check_pixels(irradiance, {{3.0110f, 6.1042f, 9.2806f}}, 0.01, method);
  for (const char* method : {"ptracer", "reuse"}) {
    const TransportScene scene(irradiance);
    SensorDescription sensor;
    sensor.kind = SensorKind::irradiancemeter;
    IntegratorDescription d = scene.integrator;
    apply_override(d, {method, {}, {}});
    Diagnostics diagnostics;
    check_support(sensor, d, diagnostics);
    CHECK(diagnostics.error_count() == 1);
    sensor.kind = SensorKind::spherical;
    check_support(sensor, d, diagnostics);
    CHECK(diagnostics.error_count() == 1);
  }
}

TEST_CASE("a batch shows what its sensors show, side by side") {
  const std::string down =
      "<sensor type='orthographic'><transform name='to_world'><scale "
      "value='0.1'/><lookat origin='0,0,3' target='0,0,0' up='0,1,0'/>"
      "</transform></sensor>";
  const std::string away =
      "<sensor type='radiancemeter'><point name='origin' value='0 0 3'/>"
      "<vector name='direction' value='0 0 1'/></sensor>";
  check_pixels(ball("<sensor type='batch'>" + down + away + film(2) + "</sensor>"),
               {{0.2f, 1.0f, 2.4f}, {1, 2, 3}}, 0.02, "path", 2048);
}

TEST_CASE("a fluence meter averages over all directions") {
  // Half of the sphere of directions is covered by a black plane.
  const std::string content =
      "<sensor type='fluencemeter'><transform name='to_world'><translate z='1e-3'/></transform>" +
      film(1) +
      "</sensor><integrator type='path'/><emitter type='constant'/><shape type='rectangle'>"
      "<transform name='to_world'><scale value='1000'/></transform><bsdf type='diffuse'><rgb "
      "name='reflectance' value='0'/></bsdf></shape>";
  check_pixels(content, {Spectrum(0.5f)}, 0.01);
}

TEST_CASE("rays of a telecentric lens meet in the plane of focus") {
  const OrthographicView view{Transform(Matrix4::translate(1, 2, 3)), {20, 10}, 0.5, 100};
  const TelecentricCamera camera(view, 0.2, 5);
  const OrthographicCamera sharp(view);
  Sampler sampler(SampleSequence::independent, 2, 0, 0);
  for (uint32_t i = 0; i < 100; ++i) {
    sampler.start_sample(i);
    const Point2f u = sampler.next_2d(), film{u.x * 20, u.y * 10};
    const Ray ray = camera.sample_ray(film, sampler.next_2d()), axis = sharp.sample_ray(film, {});
    CHECK(length(ray.direction) == doctest::Approx(1).epsilon(1e-5));
    const Point3f meets = ray.origin + ray.direction * ((8 - ray.origin.z) / ray.direction.z);
    const Point3f focus = axis.origin + axis.direction * (8 - axis.origin.z);
    CHECK(max_abs(meets - focus) < 1e-4f);
  }
}

TEST_CASE("a spherical camera sees all directions, and is seen from them") {
  const Point2i size{32, 16};
  const SphericalCamera camera(
      Transform(Matrix4::translate(1, 2, 3) * Matrix4::rotate(50, 1, 2, 3)), size);
  Sampler sampler(SampleSequence::sobol, 2, 0, 0);
  double area = 0;
  const int n = 1 << 14;
  for (uint32_t i = 0; i < n; ++i) {
    sampler.start_sample(i);
    const Point2f u = sampler.next_2d(), film{u.x * 32, 0.2f + u.y * 15.6f};
    const Ray ray = camera.sample_ray(film, {});
    const auto s = camera.sample_lens(ray.origin + ray.direction * 2.0f, {});
    REQUIRE(s);
    CHECK(std::abs(s->film.x - film.x) < 5e-3f);
    CHECK(std::abs(s->film.y - film.y) < 5e-3f);
    CHECK(max_abs(s->direction + ray.direction) < 1e-5f);
    CHECK(s->importance == doctest::Approx(camera.importance(ray, 2)).epsilon(1e-3));
    const auto any = camera.sample_lens(Point3f(1, 2, 3) + square_to_sphere(u) * 3.0f, {});
    REQUIRE(any);
    area += double(any->importance) * 9 * 4 * 3.14159265 / n;
  }
  CHECK(area == doctest::Approx(32 * 16).epsilon(0.04));  // 1 / sin θ at the poles
  // The first row is +y, its left edge −z.
  const SphericalCamera plain(Transform(), size);
  CHECK(plain.sample_ray({5, 0}, {}).direction.y > 0.999f);
  CHECK(plain.sample_ray({0, 8}, {}).direction.z < -0.999f);
  CHECK(plain.sample_ray({8, 8}, {}).direction.x > 0.999f);
}
