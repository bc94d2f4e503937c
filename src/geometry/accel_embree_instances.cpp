// Many instances: a geometry of which each primitive is one.
#include <algorithm>

#include "geometry/embree.h"
#include "geometry/surface.h"

namespace duet {

namespace {

/// The box around an instance.
void instance_bounds(const RTCBoundsFunctionArguments* args) {
  const InstanceSet& set = *static_cast<const InstanceSet*>(args->geometryUserPtr);
  const Instance& instance = (*set.instances)[args->primID];
  const Bounds& group = set.bounds[instance.group];
  Bounds box;
  if (group.empty())
    box.extend(instance.to_world(Point3f(0)));
  else
    for (int i = 0; i < 8; ++i)
      box.extend(instance.to_world(Point3f(i & 1 ? group.upper.x : group.lower.x,
                                           i & 2 ? group.upper.y : group.lower.y,
                                           i & 4 ? group.upper.z : group.lower.z)));
  const Vector3f pad(kOffsetScale * std::max(max_abs(box.lower), max_abs(box.upper)));
  set_bounds(*args->bounds_o, {box.lower - pad, box.upper + pad});
}

/// The ray in the group's own space; distances along it stay what they are.
RTCRay group_ray(const Instance& instance, RTCRayN* rays, unsigned n, unsigned i) {
  const Ray world = ray_of(rays, n, i);
  RTCRay ray;
  set_ray(ray, {instance.to_world.inverse(world.origin), instance.to_world.inverse(world.direction),
                world.tmax});
  ray.tnear = RTCRayN_tnear(rays, n, i);
  return ray;
}

void intersect_instance(const RTCIntersectFunctionNArguments* args) {
  const InstanceSet& set = *static_cast<const InstanceSet*>(args->geometryUserPtr);
  const Instance& instance = (*set.instances)[args->primID];
  const unsigned n = args->N;
  RTCRayN* const rays = RTCRayHitN_RayN(args->rayhit, n);
  RTCHitN* const hits = RTCRayHitN_HitN(args->rayhit, n);
  for (unsigned i = 0; i < n; ++i) {
    if (!args->valid[i]) continue;
    RTCRayHit found;
    found.ray = group_ray(instance, rays, n, i);
    intersect_one(set.scenes[instance.group], found);
    if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
    RTCRayN_tfar(rays, n, i) = found.ray.tfar;
    RTCHitN_u(hits, n, i) = found.hit.u, RTCHitN_v(hits, n, i) = found.hit.v;
    RTCHitN_primID(hits, n, i) = found.hit.primID;
    RTCHitN_geomID(hits, n, i) = found.hit.geomID;
    RTCHitN_instID(hits, n, i, 0) = set.first_id + args->primID;
  }
}

void occlude_instance(const RTCOccludedFunctionNArguments* args) {
  const InstanceSet& set = *static_cast<const InstanceSet*>(args->geometryUserPtr);
  const Instance& instance = (*set.instances)[args->primID];
  const unsigned n = args->N;
  for (unsigned i = 0; i < n; ++i) {
    if (!args->valid[i]) continue;
    RTCRay ray = group_ray(instance, args->ray, n, i);
    occlude_one(set.scenes[instance.group], ray);
    if (ray.tfar < 0) RTCRayN_tfar(args->ray, n, i) = -INFINITY;
  }
}

}  // namespace

RTCGeometry make_instances_geometry(RTCDevice device, InstanceSet& set) {
  RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(g, uint32_t(set.instances->size()));
  rtcSetGeometryUserData(g, &set);
  rtcSetGeometryBoundsFunction(g, instance_bounds, nullptr);
  rtcSetGeometryIntersectFunction(g, intersect_instance);
  rtcSetGeometryOccludedFunction(g, occlude_instance);
  return g;
}

}  // namespace duet
