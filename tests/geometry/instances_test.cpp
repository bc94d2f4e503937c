// Many instances are one geometry, few are Embree's own: both find the same.
#include "math/sampler.h"
#include "math/warp.h"
#include "support/transport_scene.h"

using namespace duet;
using namespace duet::test;

namespace {

/// A group of a mesh and an analytic shape, one of a disk, and a mesh and a ball among the
/// instances.
const std::string kGroups =
    camera_xml("0,-3,1", "0,0,1", 8) + "<shape type='shapegroup' id='group'><shape type='cube'>" +
    grey("0.5") + "</shape>" + sphere_xml("0,0,1.5", "0.7", grey("0.5")) +
    "</shape><shape type='shapegroup' id='other'><shape type='disk'>" + grey("0.5") +
    "</shape></shape><shape type='instance'><ref id='group'/></shape><shape type='instance'>"
    "<ref id='other'/></shape>" +
    sphere_xml("0.5,0.5,0.5", "0.1", grey("0.5")) +
    "<shape type='cube'><transform name='to_world'><scale value='0.05'/><translate x='0.2' y='0.3' "
    "z='0.4'/></transform>" +
    grey("0.5") + "</shape>" + lamp_xml("0.3", "5,5,5");

/// Of both groups in a cube, turned, stretched and mirrored.
std::vector<Instance> scattered(size_t count) {
  std::vector<Instance> instances;
  for (size_t i = 0; i < count; ++i) {
    Sampler s(SampleSequence::independent, 7, 0, i);
    s.start_sample(0);
    const auto next = [&] { return double(s.next_1d()); };
    const Matrix4 to_world =
        Matrix4::translate(next(), next(), next()) *
        Matrix4::rotate(360 * next(), next(), next(), next() + 0.1) *
        Matrix4::scale(0.004, i % 3 == 0 ? -0.006 : 0.006, 0.004 + 0.01 * next());
    instances.push_back({uint32_t(i % 2), Transform(to_world), 0.02f});
  }
  return instances;
}

}  // namespace

TEST_CASE("rays find the same among many instances as among as many of Embree's own") {
  const TransportScene made(kGroups);
  const Scene& scene = *made.scene;
  const std::vector<Instance> instances = scattered(kManyInstances);
  const Accel one(scene.shapes, scene.top, scene.groups, instances, 2),
      own(scene.shapes, scene.top, scene.groups, instances, 2, AccelUse::moving);
  CHECK(length(one.bounds().upper - own.bounds().upper) < 1e-4f);
  CHECK(length(one.bounds().lower - own.bounds().lower) < 1e-4f);
  constexpr int kRays = 20000;
  int found = 0, analytic = 0, alone = 0, short_and_free = 0, same = 0;
  for (uint64_t i = 0; i < kRays; ++i) {
    Sampler s(SampleSequence::independent, 9, 0, i);
    s.start_sample(0);
    const Point2f a = s.next_2d(), b = s.next_2d();
    const float length = i % 2 == 0 ? INFINITY : 0.1f;
    const Ray ray{{a.x, a.y, s.next_1d()}, square_to_sphere(b), length};
    Hit hit, other;
    const bool any = one.closest_hit(ray, hit);
    const bool blocked = one.occluded(ray);
    if (any != own.closest_hit(ray, other) || blocked != own.occluded(ray) || any != blocked)
      continue;
    if (any &&
        (hit.shape != other.shape || hit.instance != other.instance ||
         hit.primitive != other.primitive || std::abs(hit.t - other.t) > 1e-4f * hit.t + 1e-6f))
      continue;
    ++same;
    found += any;
    analytic += any && scene.shapes[hit.shape].kind != ShapeKind::mesh;
    alone += any && hit.instance == kNone;
    short_and_free += !any && i % 2 == 1;
  }
  // But for rays that meet an edge.
  CHECK(same >= kRays - kRays / 1000);
  CHECK(found > kRays / 4);
  CHECK(analytic > kRays / 20);
  CHECK(alone > kRays / 200);
  CHECK(short_and_free > kRays / 20);
}

TEST_CASE("packets of rays find what each finds by itself among many instances") {
  const TransportScene made(kGroups);
  const Scene& scene = *made.scene;
  const std::vector<Instance> instances = scattered(kManyInstances);
  const Accel accel(scene.shapes, scene.top, scene.groups, instances, 2);
  const auto rays = std::make_unique<RayBatch>();
  const auto hits = std::make_unique<HitBatch>();
  const auto blocked = std::make_unique<BatchArray<int32_t>>();
  for (int i = 0; i < kBatch; ++i) {
    Sampler s(SampleSequence::independent, 11, 0, uint64_t(i));
    s.start_sample(0);
    const Point2f a = s.next_2d(), b = s.next_2d();
    rays->origin.set(i, a.x, a.y, s.next_1d());
    rays->direction.set(i, square_to_sphere(b));
    rays->tmax[i] = i % 2 == 0 ? INFINITY : 0.1f;
  }
  accel.closest_hits(*rays, kBatch, *hits);
  accel.occluded(*rays, kBatch, *blocked);
  int same = 0;
  for (int i = 0; i < kBatch; ++i) {
    Hit hit;
    const bool any = accel.closest_hit((*rays)[i], hit);
    same += any == (hits->shape[i] != kNone) && any == ((*blocked)[i] != 0) &&
            (!any || (hit.shape == hits->shape[i] && hit.instance == hits->instance[i] &&
                      hit.primitive == hits->primitive[i]));
  }
  CHECK(same >= kBatch - kBatch / 1000);
}
