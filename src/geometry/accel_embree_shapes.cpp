// Shapes that Embree does not know: it calls functions of ours where rays meet their boxes.
#include "geometry/embree.h"
#include "geometry/quadric.h"
#include "geometry/ribbon.h"

namespace duet {

namespace {

/// As wide as packets are.
constexpr unsigned kMostLanes = 16;

const Shape& shape_of(const void* user_data) {
  return *static_cast<const Shape*>(user_data);
}

void analytic_box(const RTCBoundsFunctionArguments* args) {
  set_bounds(*args->bounds_o, analytic_bounds(shape_of(args->geometryUserPtr), args->primID));
}

void ribbon_box(const RTCBoundsFunctionArguments* args) {
  set_bounds(*args->bounds_o, ribbon_bounds(*shape_of(args->geometryUserPtr).curves, args->primID));
}

/// For each ray of a packet the distance of an analytic shape, or INFINITY; rays that are not valid
/// get anything. `t` has room for kMostLanes.
void distances(const Shape& shape, uint32_t part, RTCRayN* rays, unsigned n, float* t) {
  if (n > 1 && shape.kind != ShapeKind::sdf_grid) {
    const RayLanes lanes{&RTCRayN_org_x(rays, n, 0), &RTCRayN_org_y(rays, n, 0),
                         &RTCRayN_org_z(rays, n, 0), &RTCRayN_tnear(rays, n, 0),
                         &RTCRayN_dir_x(rays, n, 0), &RTCRayN_dir_y(rays, n, 0),
                         &RTCRayN_dir_z(rays, n, 0), &RTCRayN_tfar(rays, n, 0)};
    quadric_distances(shape, lanes, n, t);
    return;
  }
  for (unsigned i = 0; i < n; ++i)
    t[i] = float(
        analytic_distance(shape, part, ray_of(rays, n, i), double(RTCRayN_tnear(rays, n, i))));
}

/// Tells Embree about a hit of the ray in place `i`.
void report(const RTCIntersectFunctionNArguments* args, unsigned i, const RibbonHit& hit,
            uint32_t primitive) {
  const unsigned n = args->N;
  RTCHitN* const hits = RTCRayHitN_HitN(args->rayhit, n);
  RTCRayN_tfar(RTCRayHitN_RayN(args->rayhit, n), n, i) = hit.t;
  RTCHitN_u(hits, n, i) = hit.u, RTCHitN_v(hits, n, i) = 0;
  RTCHitN_primID(hits, n, i) = primitive;
  RTCHitN_geomID(hits, n, i) = args->geomID;
  RTCHitN_instID(hits, n, i, 0) = args->context->instID[0];
}

void intersect_shape(const RTCIntersectFunctionNArguments* args) {
  const unsigned n = args->N;
  float t[kMostLanes];
  distances(shape_of(args->geometryUserPtr), args->primID, RTCRayHitN_RayN(args->rayhit, n), n, t);
  for (unsigned i = 0; i < n; ++i)
    if (args->valid[i] && t[i] < INFINITY) report(args, i, {t[i], 0}, args->primID);
}

void occlude_shape(const RTCOccludedFunctionNArguments* args) {
  const unsigned n = args->N;
  float t[kMostLanes];
  distances(shape_of(args->geometryUserPtr), args->primID, args->ray, n, t);
  for (unsigned i = 0; i < n; ++i)
    if (args->valid[i] && t[i] < INFINITY) RTCRayN_tfar(args->ray, n, i) = -INFINITY;
}

void intersect_curve(const RTCIntersectFunctionNArguments* args) {
  const CurveSet& curves = *shape_of(args->geometryUserPtr).curves;
  const unsigned n = args->N;
  RTCRayN* const rays = RTCRayHitN_RayN(args->rayhit, n);
  for (unsigned i = 0; i < n; ++i) {
    RibbonHit hit;
    if (args->valid[i] &&
        intersect_ribbon(curves, args->primID, ray_of(rays, n, i), RTCRayN_tnear(rays, n, i), hit))
      report(args, i, hit, args->primID / kRibbonParts);
  }
}

void occlude_curve(const RTCOccludedFunctionNArguments* args) {
  const CurveSet& curves = *shape_of(args->geometryUserPtr).curves;
  const unsigned n = args->N;
  for (unsigned i = 0; i < n; ++i) {
    RibbonHit hit;
    if (args->valid[i] && intersect_ribbon(curves, args->primID, ray_of(args->ray, n, i),
                                           RTCRayN_tnear(args->ray, n, i), hit))
      RTCRayN_tfar(args->ray, n, i) = -INFINITY;
  }
}

RTCGeometry make_geometry_of(RTCDevice device, const Shape& shape, uint32_t parts,
                             RTCBoundsFunction box, RTCIntersectFunctionN intersect,
                             RTCOccludedFunctionN occlude) {
  RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(g, parts);
  rtcSetGeometryUserData(g, const_cast<Shape*>(&shape));
  rtcSetGeometryBoundsFunction(g, box, nullptr);
  rtcSetGeometryIntersectFunction(g, intersect);
  rtcSetGeometryOccludedFunction(g, occlude);
  return g;
}

}  // namespace

RTCGeometry make_analytic_geometry(RTCDevice device, const Shape& shape) {
  return make_geometry_of(device, shape, shape.analytic_parts(), analytic_box, intersect_shape,
                          occlude_shape);
}

RTCGeometry make_ribbon_geometry(RTCDevice device, const Shape& shape) {
  const uint32_t parts = uint32_t(shape.curves->segments.size()) * kRibbonParts;
  return make_geometry_of(device, shape, parts, ribbon_box, intersect_curve, occlude_curve);
}

}  // namespace duet
