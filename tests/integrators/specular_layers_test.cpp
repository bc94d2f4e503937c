// What denoisers are told of mirrors and glass.
#include "integrators/specular_layers.h"

#include <doctest/doctest.h>

#include <cmath>

#include "integrators/pass.h"
#include "support/transport_scene.h"

using namespace duet;

namespace {

/// The mean of six channels, albedo and normal, that a camera at z = 5 sees of what is around the
/// z axis.
std::vector<double> seen(const std::string& shapes) {
  const test::TransportScene scene(
      "<sensor type='orthographic'><transform name='to_world'><scale value='0.01'/><lookat "
      "origin='0, 0, 5' target='0, 0, 0' up='0, 1, 0'/></transform><film type='hdrfilm'><integer "
      "name='width' value='8'/><integer name='height' value='8'/><rfilter type='box'/></film>"
      "</sensor>" +
      shapes);
  IntegratorDescription layers;
  layers.image = false;
  layers.aovs.layers = {{"denoise_albedo", "a"}, {"denoise_normal", "n"}};
  RenderRequest request;
  request.budget.spp = 256;
  const auto integrator = make_integrator(layers);
  const Image image = render(*scene.scene, *integrator, scene.layout, request).image;
  REQUIRE(image.channels.size() == 6);
  std::vector<double> mean(6);
  for (size_t i = 0; i < image.data.size(); ++i) mean[i % 6] += double(image.data[i]) / 64;
  return mean;
}

const std::string kWall =
    "<shape type='rectangle'><transform name='to_world'><scale value='9'/></transform><bsdf "
    "type='diffuse'><rgb name='reflectance' value='0.5, 0.25, 0.125'/></bsdf></shape>";

std::string before(const std::string& bsdf, const std::string& turn = "") {
  return "<shape type='rectangle'><transform name='to_world'>" + turn +
         "<translate z='2'/></transform>" + bsdf + "</shape>";
}

const std::string kMirror =
    "<bsdf type='twosided'><bsdf type='conductor'><string name='material' value='none'/><rgb "
    "name='specular_reflectance' value='0.5'/></bsdf></bsdf>";

void check(const std::vector<double>& found, const std::vector<double>& expected) {
  REQUIRE(found.size() == expected.size());
  for (size_t i = 0; i < found.size(); ++i) {
    CAPTURE(i);
    CHECK(found[i] == doctest::Approx(expected[i]).epsilon(0.01));
  }
}

}  // namespace

TEST_CASE("what scatters has its own albedo and normal") {
  check(seen(kWall), {0.5, 0.25, 0.125, 0, 0, 1});
  const std::string plastic =
      before("<bsdf type='plastic'><rgb name='diffuse_reflectance' value='0.3, 0.2, 0.1'/></bsdf>");
  // What the base scatters and the coat reflects; neither the wall behind, nor what is mirrored.
  const auto found = seen(kWall + plastic);
  CHECK(found[0] > 0.25);
  CHECK(found[0] < 0.4);
  CHECK(found[0] - found[2] > 0.15);
  CHECK(found[5] == doctest::Approx(1));
  check(seen(""), {0, 0, 0, 0, 0, 0});
}

TEST_CASE("a mirror shows what is seen in it, and takes its share") {
  // Turned by 135 degrees about y it shows a wall at x = 5, whose normal is −x.
  const std::string side =
      "<shape type='rectangle'><transform name='to_world'><scale value='4'/><rotate y='1' "
      "angle='-90'/><translate x='5' z='2'/></transform><bsdf type='diffuse'><rgb "
      "name='reflectance' value='0.8, 0.4, 0.2'/></bsdf></shape>";
  check(seen(kWall + side + before(kMirror, "<rotate y='1' angle='45'/>")),
        {0.4, 0.2, 0.1, -1, 0, 0});
}

TEST_CASE("glass shows what is behind it in proportion to the light that passes") {
  // Fresnel at normal incidence, with all reflections within the pane: 2 r / (1 + r).
  const double r = std::pow(0.5 / 2.5, 2), passed = 1 - 2 * r / (1 + r);
  const std::string pane = before(
      "<bsdf type='thindielectric'><float name='int_ior' value='1.5'/>"
      "<float name='ext_ior' value='1'/></bsdf>");
  check(seen(kWall + pane), {0.5 * passed, 0.25 * passed, 0.125 * passed, 0, 0, passed});
}

TEST_CASE("what is within glass is not brighter for the index of refraction") {
  const std::string ball =
      "<shape type='sphere'><float name='radius' value='2'/><bsdf type='dielectric'><float "
      "name='int_ior' value='1.5'/><float name='ext_ior' value='1'/></bsdf></shape><shape "
      "type='sphere'><bsdf type='diffuse'><rgb name='reflectance' value='0.5'/></bsdf></shape>";
  const double passed = 1 - std::pow(0.5 / 2.5, 2);
  check(seen(ball), {0.5 * passed, 0.5 * passed, 0.5 * passed, 0, 0, passed});
}

TEST_CASE("a mask shows what is behind it in proportion to what it lets pass") {
  const std::string mask = before(
      "<bsdf type='mask'><float name='opacity' value='0.25'/><bsdf type='diffuse'><rgb "
      "name='reflectance' value='0.9'/></bsdf></bsdf>");
  check(seen(kWall + mask),
        {0.25 * 0.9 + 0.75 * 0.5, 0.25 * 0.9 + 0.75 * 0.25, 0.25 * 0.9 + 0.75 * 0.125, 0, 0, 1});
}

TEST_CASE("between mirrors there is an end") {
  // The camera stands between two walls of a mirror box.
  const std::string box =
      "<shape type='sphere'><float name='radius' value='9'/>" + kMirror + "</shape>";
  const auto found = seen(box);
  CHECK(found[0] > 0);
  CHECK(found[0] < 1e-3);
}
