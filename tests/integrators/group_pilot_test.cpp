#include "integrators/group_pilot.h"

#include "integrators/batch_cases.h"

using namespace duet;
using namespace duet::test;

namespace {

/// A room with small bright lamps in view.
std::string room_with_lamps() {
  const std::string lamp = "<emitter type='area'><rgb name='radiance' value='90,80,70'/></emitter>";
  return camera() + room_xml(grey("0.6")) + sphere_xml("-0.5,0.2,1.2", "0.06", lamp) +
         sphere_xml("0.1,0.2,1.5", "0.06", lamp) + sphere_xml("0.6,0.2,0.7", "0.06", lamp);
}

GroupGains gains(const TransportScene& scene, uint64_t seed, bool hide_emitters) {
  PricingPlan plan;
  plan.max_depth = 6;
  plan.hide_emitters = hide_emitters;
  plan.film = {kSize, kSize};
  plan.seed = seed;
  return measure_pixel_groups(*scene.scene, plan);
}

}  // namespace

TEST_CASE("groups gain as much where lamps are seen as where they are hidden") {
  const TransportScene scene(room_with_lamps());
  double seen = 0, hidden = 0;
  for (uint64_t seed = 0; seed < 8; ++seed) {
    seen += gains(scene, seed, false)[0].variance / 8;
    hidden += gains(scene, seed, true)[0].variance / 8;
  }
  // At the edges of a lamp samples differ by all of its light, in groups as well.
  CHECK(seen < 1.3 * hidden);
  CHECK(hidden < 0.6);
}

TEST_CASE("the gain of groups does not depend on the number of threads") {
  const TransportScene scene(room_with_lamps());
  PricingPlan plan;
  plan.film = {kSize, kSize};
  const GroupGains one = measure_pixel_groups(*scene.scene, plan);
  plan.threads = 3;
  const GroupGains three = measure_pixel_groups(*scene.scene, plan);
  for (size_t g = 0; g < one.size(); ++g) {
    CHECK(one[g].variance == three[g].variance);
    CHECK(one[g].shadow_rays == three[g].shadow_rays);
  }
}
