// Bidirectional path tracing in groups of pixels has the same mean as without, and less noise.
#include "integrators/wide_eye_groups.h"

#include "base/failures.h"
#include "integrators/bidirectional.h"
#include "integrators/group_checks.h"

using namespace duet;
using namespace duet::test;

namespace {

using Options = BidirectionalIntegratorDescription;

RenderGroup with_bdpt(const TransportScene& s, const Options& options = {}) {
  return [&s, options](int members, const RenderRequest& r) {
    Options d = options;
    d.pixel_group = members;
    BidirectionalIntegrator bdpt(d, {});
    return render(*s.scene, bdpt, s.layout, r).image;
  };
}

void check_means(const TransportScene& scene, const Options& options, int members) {
  const Differences d = compare_means(with_bdpt(scene, options), members);
  CAPTURE(d.mean);
  CAPTURE(d.error);
  CAPTURE(d.worst);
  CHECK(d.error < 0.004);
  CHECK(std::abs(d.mean) < 4 * d.error + 1e-4);
  CHECK(d.worst < 7);
}

Options short_paths() {
  Options o;
  o.max_depth = 6;
  o.rr_depth = 1;
  return o;
}

}  // namespace

TEST_CASE("bdpt in groups of pixels has the mean of bdpt") {
  for (const BatchCase& c : kBatchCases) {
    CAPTURE(std::string(c.name));
    check_means(c.scene(), short_paths(), 16);
  }
}

TEST_CASE("so it has without some of its techniques, with hidden emitters and strict normals") {
  Options o = short_paths();
  o.light_paths = 1;
  int members = 16;
  SUBCASE("as many light sub-paths as pixels") {}
  SUBCASE("no light image") {
    o.light_image = false;
  }
  SUBCASE("no connections") {
    o.connections = 0;
  }
  SUBCASE("neither") {
    o.light_image = false;
    o.connections = 0;
  }
  SUBCASE("limits") {
    o.hide_emitters = o.strict_normals = true;
    members = 5;
  }
  for (const size_t number : {0, 1, 2, 3}) {
    CAPTURE(number);
    check_means(kBatchCases[number].scene(), o, members);
  }
}

// Weights that do not add up to one for each pixel may do so for the group. With many light
// sub-paths they have the most to say: weights of another pixel of the group make the figure 7,
// with the usual number of them 1.3.
TEST_CASE("each pixel of a group has the mean of bdpt") {
  const TransportScene scene(
      TemporaryDirectory(),
      camera_xml("0,-3.2,1", "0,0,1", 16) + room_xml(grey("0.7")) + kLamp +
          sphere_xml("-0.5,0.2,0.5", "0.5",
                     ggx_plastic("<rgb name='diffuse_reflectance' value='0.6,0.5,0.4'/>")) +
          lumpy_xml("0.5,0,0.5", kPatternedMetal));
  Options o;
  o.light_paths = 4;
  const PixelDifferences d = compare_pixels(with_bdpt(scene, o), 16, 64);
  CAPTURE(d.z2);
  CHECK(d.error < 0.006);
  CHECK(d.z2 < 1.35);
}

TEST_CASE("bdpt in groups of pixels has less noise where light comes from diffuse surfaces") {
  const TransportScene scene(camera() + room_xml(grey("0.7")) + lamp_xml("0.3", "9,8,7"));
  Options o;
  o.hide_emitters = true;  // whose edges have more noise than all else
  const RenderGroup render = with_bdpt(scene, o);
  const double ratio = median_noise(render, 16) / median_noise(render, 1);
  CAPTURE(ratio);
  CHECK(ratio < 0.75);
}

TEST_CASE("bdpt in groups makes the same image on any number of threads, in passes and windows") {
  TransportScene scene(coplanar());
  check_bits(with_bdpt(scene), scene);
}

TEST_CASE("groups of pixels are refused where sub-paths are traced one by one") {
  const TransportScene scene(camera() + room_xml(grey("0.7")) + lamp_xml("0.3", "9,8,7"));
  Options o;
  SUBCASE("connections that are drawn") {
    o.connections = 2;
  }
  SUBCASE("no paths") {
    o.max_depth = 0;
  }
  CHECK_THROWS_AS(with_bdpt(scene, o)(2, batch_request(1, SampleSequence::sobol)), SceneFailure);
}
