// Russian roulette: that it loses no light, and what lengths it gives to paths.
#include "transport/roulette.h"

#include "math/statistics.h"
#include "support/transport_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

/// The inside of a ball around the camera.
TransportScene closed_ball(const std::string& bsdf, const std::string& more = "") {
  return TransportScene(
      camera_xml("0 0 0", "1 0 0", 16) +
      sphere_xml("0 0 0", "1", "<boolean name='flip_normals' value='true'/>" + bsdf + more));
}

const std::string kGlow = "<emitter type='area'><rgb name='radiance' value='1'/></emitter>";

}  // namespace

TEST_CASE("roulette loses no light where it is everywhere the same") {
  // Radiance is 1 + a + a² + …
  for (const double albedo : {0.3, 0.7}) {
    CAPTURE(albedo);
    const TransportScene scene = closed_ball(grey(std::to_string(albedo)), kGlow);
    for (const char* method : {"path", "volpath", "bdpt", "vcm", "reuse"}) {
      CAPTURE(std::string(method));
      const Image image = scene.render(method, {{"rr_depth", "1"}}, 256, 1).image;
      Moments radiance;
      for (size_t i = 0; i < image.data.size(); i += 4) radiance.add(double(image.data[i]));
      // A path that goes on without making up for those that end takes 1 % or more.
      CHECK(std::abs(radiance.mean() * (1 - albedo) - 1) < 0.004);
    }
  }
}

TEST_CASE("roulette ends most of what carries little, and in time what carries all") {
  for (const Roulette& r : {kPathRoulette, kSubpathRoulette, kMediaRoulette}) {
    CHECK(r.probability(0.01f) == doctest::Approx(0.01 * double(r.factor)));
    CHECK(r.probability(1) == r.most);
  }
  CHECK(kPathRoulette.at(Roulette::kSure - 1).probability(1) == 1);
  const TransportScene mirrors =
      closed_ball("<bsdf type='conductor'><string name='material' value='none'/></bsdf>");
  const RenderCounters c = mirrors.render("path", {{"rr_depth", "2"}}, 64, 1).counters;
  // So many vertices that are sure, and 1 / (1 - most) others.
  CHECK(double(c.path_vertices) / double(c.camera_paths) ==
        doctest::Approx(Roulette::kSure - 1 + 1 / (1 - double(kPathRoulette.most))).epsilon(0.03));
}
