// Light in one direction, which only sub-paths from it carry.
#include "lights/beam.h"

#include <doctest/doctest.h>

#include "support/transport_scene.h"

using namespace duet;
using namespace duet::test;

TEST_CASE("a beam leaves along its axis with all its power") {
  const CollimatedBeam beam(Transform(Matrix4::translate(1, 2, 3) * Matrix4::scale(2, 2, 2)),
                            Spectrum(1, 2, 3));
  const auto e = beam.sample_emission({0.2f, 0.3f}, {0.4f, 0.5f});
  REQUIRE(e);
  CHECK(e->ray.origin == Point3f(1, 2, 3));
  CHECK(e->ray.direction == Vector3f(0, 0, 1));
  CHECK(e->weight == Spectrum(1, 2, 3));
  CHECK_FALSE(beam.sample_direct({0, 0, 0}, {0.2f, 0.3f}));
  CHECK_FALSE(CollimatedBeam(Transform(), Spectrum(0)).sample_emission({}, {}));
}

TEST_CASE("a directional area lights what lies before it, for methods that trace light sub-paths") {
  // A square of side 1 that shines down on a white floor of side 4, seen from below the light.
  const std::string content =
      camera_xml("0,-3,3", "0,0,0", 24) +
      "<shape type='rectangle'><transform name='to_world'><scale value='2'/></transform>" +
      "<bsdf type='diffuse'><rgb name='reflectance' value='0.5'/></bsdf></shape>"
      "<shape type='rectangle'><transform name='to_world'><scale value='0.5'/><rotate x='1' "
      "angle='180'/><translate z='1'/></transform><bsdf type='diffuse'><rgb name='reflectance' "
      "value='0'/></bsdf><emitter type='directionalarea'><rgb name='radiance' value='2 4 6'/>"
      "</emitter></shape><integrator type='bdpt'><integer name='max_depth' "
      "value='3'/></integrator>";
  const TransportScene scene(content);
  const auto sum = [&](const std::string& method) {
    const RenderResult r = scene.render(method, {}, 64, 7);
    double g = 0;
    for (size_t i = 1; i < r.image.data.size(); i += 4) g += double(r.image.data[i]);
    return g / (24 * 24);
  };
  const double ptracer = sum("ptracer");
  // Each point of the lit square sends 4 · 0.5 / π; the others nothing.
  CHECK(ptracer > 0.02);
  CHECK(ptracer < 4 * 0.5 / 3.14159265);
  CHECK(sum("bdpt") == doctest::Approx(ptracer).epsilon(0.03));
  CHECK(sum("vcm") == doctest::Approx(ptracer).epsilon(0.05));
  CHECK(sum("path") == 0);
  const RenderResult r = scene.render("ptracer", {}, 256, 3);
  float brightest = 0;
  for (size_t i = 1; i < r.image.data.size(); i += 4)
    brightest = std::max(brightest, r.image.data[i]);
  CHECK(brightest == doctest::Approx(4 * 0.5 / 3.14159265).epsilon(0.1));
}
