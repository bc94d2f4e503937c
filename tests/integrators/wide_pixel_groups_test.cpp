// Paths in groups of pixels have the same mean as paths on their own, and less noise.
#include "integrators/wide_path_groups.h"

#include "base/failures.h"
#include "integrators/group_checks.h"
#include "integrators/path.h"

using namespace duet;
using namespace duet::test;

namespace {

RenderGroup with_path(const TransportScene& s, const PathLimits& limits = {}) {
  return [&s, limits](int members, const RenderRequest& r) {
    PathIntegratorDescription d{limits};
    d.pixel_group = members;
    PathIntegrator path(d, {});
    return render(*s.scene, path, s.layout, r).image;
  };
}

/// Plastic whose coat reflects more than its base.
const std::string kDark = ggx_plastic(
    "<float name='alpha' value='0.25'/><float name='int_ior' value='2.2'/>"
    "<rgb name='diffuse_reflectance' value='0.3,0.15,0.1'/>");

}  // namespace

// With these seeds it notices 1 % of the image (usually 0.2 %).
TEST_CASE("paths in groups of pixels have the mean of paths on their own") {
  std::vector<BatchCase> cases = kBatchCases;
  cases.push_back({"shiny and patterned balls in a diffuse room",
                   camera() + room_xml(grey("0.7")) + kLamp +
                       sphere_xml("-0.5,0.2,0.5", "0.5", smooth_plastic("")) +
                       lumpy_xml("0.5,0,0.5", kPatternedMetal) +
                       lumpy_xml("0.1,-0.4,1.2", kPatternedMetal)});
  cases.push_back({"coloured rough plastics of both kinds of facets, light on their backs",
                   camera() + room_xml(kDark) + kLamp + lumpy_xml("-0.5,0.2,0.5", kTinted) +
                       lumpy_xml("0.5,0,0.5", kVarnishedCheckers) +
                       hollow_xml("0.1,-0.4,1.2", "0.4", kPlastic)});
  for (const BatchCase& c : cases) {
    CAPTURE(std::string(c.name));
    const TransportScene scene = c.scene();
    PathLimits limits;
    limits.max_depth = 6;
    limits.rr_depth = 1;
    const Differences d = compare_means(with_path(scene, limits), 16);
    CAPTURE(d.mean);
    CAPTURE(d.error);
    CAPTURE(d.worst);
    CHECK(d.error < 0.0025);
    CHECK(std::abs(d.mean) < 4 * d.error + 1e-4);
    CHECK(d.worst < 7);
  }
}

TEST_CASE("so they have with hidden emitters, strict normals and groups of other sizes") {
  PathLimits limits;
  limits.hide_emitters = limits.strict_normals = true;
  for (const size_t number : {0, 1, 2, 3})
    for (const int members : {3, 64}) {
      CAPTURE(number);
      CAPTURE(members);
      const TransportScene scene = kBatchCases[number].scene();
      const Differences d = compare_means(with_path(scene, limits), members);
      CAPTURE(d.mean);
      CAPTURE(d.error);
      CHECK(std::abs(d.mean) < 4 * d.error + 1e-4);
      CHECK(d.worst < 7);
    }
}

// What the pixels of a group have from one another may be right in sum but in none of them. The
// figure is 1.05 ± 0.1: half a standard error in every pixel is noticed.
TEST_CASE("each pixel of a group has the mean of its own paths") {
  const TransportScene scene(
      TemporaryDirectory(),
      camera_xml("0,-3.2,1", "0,0,1", 16) + room_xml(kDark) + kLamp +
          sphere_xml("-0.5,0.2,0.5", "0.5",
                     ggx_plastic("<rgb name='diffuse_reflectance' value='0.6,0.5,0.4'/>")) +
          lumpy_xml("0.5,0,0.5", kVarnishedCheckers));
  const PixelDifferences d = compare_pixels(with_path(scene), 16, 64);
  CHECK(d.error < 0.005);
  CHECK(d.z2 < 1.35);
}

TEST_CASE("groups of pixels have less noise where light comes from diffuse bases") {
  const std::string base = "<rgb name='diffuse_reflectance' value='0.7,0.6,0.5'/>";
  std::string walls;
  SUBCASE("walls") {
    walls = grey("0.7");
  }
  SUBCASE("smooth plastics") {
    walls = smooth_plastic(base);
  }
  SUBCASE("rough plastics") {
    walls = ggx_plastic(base);
  }
  const TransportScene scene(camera() + room_xml(walls) + lamp_xml("0.3", "9,8,7"));
  PathLimits limits;
  limits.hide_emitters = true;  // whose edges have more noise than all else
  // By medians: what coats mirror is as noisy as before.
  const RenderGroup render = with_path(scene, limits);
  const double ratio = median_noise(render, 16) / median_noise(render, 1);
  CAPTURE(ratio);
  CHECK(ratio < 0.75);
}

TEST_CASE("groups of pixels make the same image on any number of threads, in passes and windows") {
  TransportScene scene(coplanar());
  check_bits(with_path(scene), scene);
}

TEST_CASE("groups of pixels are refused where paths are traced one by one") {
  const TransportScene scene(camera() + room_xml(grey("0.7")) + lamp_xml("0.3", "9,8,7"));
  const RenderRequest one = batch_request(1, SampleSequence::sobol);
  PathIntegratorDescription d;
  d.pixel_group = 16;
  d.only_specular = true;
  PathIntegrator path(d, {});
  CHECK_THROWS_AS(render(*scene.scene, path, scene.layout, one), SceneFailure);
  PathLimits none;
  none.max_depth = 0;
  CHECK_THROWS_AS(with_path(scene, none)(2, one), SceneFailure);
}
