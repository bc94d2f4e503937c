#include "geometry/ray_batch.h"

#include "math/sampler.h"
#include "math/warp.h"
#include "support/transport_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

/// Meshes, analytic shapes and instances of both.
const std::string kScene =
    camera_xml("0,-3,1", "0,0,1", 8) + room_xml(grey("0.5")) +
    sphere_xml("-0.3,0.2,0.4", "0.4", grey("0.5")) +
    "<shape type='disk'><transform name='to_world'><scale value='0.3'/><rotate x='1' angle='40'/>"
    "<translate x='0.5' z='1.2'/></transform>" +
    grey("0.5") + "</shape><shape type='shapegroup' id='group'><shape type='cube'>" + grey("0.5") +
    "</shape>" + sphere_xml("0,0,1.5", "0.7", grey("0.5")) +
    "</shape><shape type='instance'><ref id='group'/><transform name='to_world'>"
    "<scale value='0.15'/><translate x='0.5' y='-0.3' z='0.3'/></transform></shape>" +
    lamp_xml("0.3", "5,5,5");

/// Rays of many directions from within the room, some of them short.
void fill(RayBatch& rays, uint64_t pixel) {
  for (int i = 0; i < kBatch; ++i) {
    Sampler s(SampleSequence::independent, 5, 0, pixel);
    s.start_sample(uint32_t(i));
    const Point2f a = s.next_2d(), b = s.next_2d();
    rays.origin.set(i, 1.6f * a.x - 0.8f, 1.6f * a.y - 0.8f, 0.1f + 1.8f * s.next_1d());
    rays.direction.set(i, square_to_sphere(b));
    rays.tmax[i] = i % 3 == 0 ? 0.5f : INFINITY;
  }
}

}  // namespace

TEST_CASE("rays of a batch find what each finds by itself") {
  const TransportScene scene(kScene);
  const Accel& accel = *scene.scene->accel;
  const auto rays = std::make_unique<RayBatch>();
  const auto hits = std::make_unique<HitBatch>();
  const auto blocked = std::make_unique<BatchArray<int32_t>>();
  int found = 0, instanced = 0, analytic = 0, same = 0, asked = 0;
  for (uint64_t round = 0; round < 40; ++round)
    for (const int n : {kBatch, 17, 1}) {
      fill(*rays, round);
      accel.closest_hits(*rays, n, *hits);
      accel.occluded(*rays, n, *blocked);
      for (int i = 0; i < n; ++i, ++asked) {
        Hit hit;
        const Ray ray = (*rays)[i];
        const bool any = accel.closest_hit(ray, hit);
        REQUIRE(((*blocked)[i] == 1 || (*blocked)[i] == 0));
        if (((*blocked)[i] != 0) != accel.occluded(ray)) continue;
        if (any != (hits->shape[i] != kNone)) continue;
        if (any &&
            (hit.shape != hits->shape[i] || hit.instance != hits->instance[i] ||
             hit.primitive != hits->primitive[i] || std::abs(hit.t - hits->t[i]) > 1e-5f * hit.t ||
             std::abs(hit.u - hits->u[i]) > 1e-4f || std::abs(hit.v - hits->v[i]) > 1e-4f))
          continue;
        ++same;
        found += any;
        instanced += any && hit.instance != kNone;
        analytic += any && scene.scene->shapes[hit.shape].kind != ShapeKind::mesh;
      }
    }
  // But for rays that meet an edge.
  CHECK(same >= asked - 3);
  CHECK(found > asked / 2);
  CHECK(instanced > asked / 100);
  CHECK(analytic > asked / 100);
}
