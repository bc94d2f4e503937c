// Embree's header, of version 3 or 4; for src/geometry/accel_embree*.cpp alone.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "geometry/shape.h"
#include "math/vector.h"

namespace duet {

inline void set_ray(RTCRay& r, const Ray& ray) {
  // Embree reads origin and direction as vectors of four: what is written piece by piece and read
  // as a whole has to wait until it has left the store buffer.
  using Four [[gnu::vector_size(16), gnu::may_alias]] = float;
  *reinterpret_cast<Four*>(&r.org_x) = Four{ray.origin.x, ray.origin.y, ray.origin.z, 0};
  *reinterpret_cast<Four*>(&r.dir_x) = Four{ray.direction.x, ray.direction.y, ray.direction.z, 0};
  r.tfar = ray.tmax;
  r.mask = ~0u, r.id = 0, r.flags = 0;
}

inline void intersect_one(RTCScene scene, RTCRayHit& rays) {
  rays.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rays.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
  rtcIntersect1(scene, &rays);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &rays);
#endif
}

inline void occlude_one(RTCScene scene, RTCRay& ray) {
#if RTC_VERSION_MAJOR >= 4
  rtcOccluded1(scene, &ray);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, &ray);
#endif
}

/// The ray in place `i` of a packet of `n`.
inline Ray ray_of(RTCRayN* rays, unsigned n, unsigned i) {
  return {{RTCRayN_org_x(rays, n, i), RTCRayN_org_y(rays, n, i), RTCRayN_org_z(rays, n, i)},
          {RTCRayN_dir_x(rays, n, i), RTCRayN_dir_y(rays, n, i), RTCRayN_dir_z(rays, n, i)},
          RTCRayN_tfar(rays, n, i)};
}

inline void set_bounds(RTCBounds& to, const Bounds& b) {
  to.lower_x = b.lower.x, to.lower_y = b.lower.y, to.lower_z = b.lower.z;
  to.upper_x = b.upper.x, to.upper_y = b.upper.y, to.upper_z = b.upper.z;
}
/// Empty if there is nothing in the scene.
inline Bounds bounds_of(RTCScene scene) {
  RTCBounds b;
  rtcGetSceneBounds(scene, &b);
  if (!(b.lower_x <= b.upper_x)) return {};
  return {{b.lower_x, b.lower_y, b.lower_z}, {b.upper_x, b.upper_y, b.upper_z}};
}

/// Analytic shapes and ribbons, which Embree does not know. The geometry refers to the shape.
RTCGeometry make_analytic_geometry(RTCDevice device, const Shape& shape);
RTCGeometry make_ribbon_geometry(RTCDevice device, const Shape& shape);

/// Instances as the primitives of one geometry. Embree's own need three times the memory.
struct InstanceSet {
  const std::vector<Instance>* instances;
  std::vector<RTCScene> scenes;  ///< of the groups
  std::vector<Bounds> bounds;    ///< of the groups
  uint32_t first_id;             ///< in hits, of the first instance
};
/// The geometry refers to the set.
RTCGeometry make_instances_geometry(RTCDevice device, InstanceSet& set);

}  // namespace duet
