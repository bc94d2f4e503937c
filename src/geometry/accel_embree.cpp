// Builds Embree's acceleration structures; accel_embree_queries.cpp asks them. No other file knows
// Embree.
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <fmt/format.h>

#include <stdexcept>

#include "geometry/accel.h"

namespace duet {

namespace {

void check(RTCDevice device, const char* doing) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return;
  throw std::runtime_error(
      fmt::format("Embree failed {}: {}", doing,
                  error == RTC_ERROR_OUT_OF_MEMORY ? "out of memory" : "internal error"));
}

void analytic_bounds_callback(const RTCBoundsFunctionArguments* args) {
  const Bounds b = analytic_bounds(*static_cast<const Shape*>(args->geometryUserPtr), args->primID);
  args->bounds_o->lower_x = b.lower.x;
  args->bounds_o->lower_y = b.lower.y;
  args->bounds_o->lower_z = b.lower.z;
  args->bounds_o->upper_x = b.upper.x;
  args->bounds_o->upper_y = b.upper.y;
  args->bounds_o->upper_z = b.upper.z;
}

Ray ray_of(RTCRayN* rays, unsigned n, unsigned i) {
  return {{RTCRayN_org_x(rays, n, i), RTCRayN_org_y(rays, n, i), RTCRayN_org_z(rays, n, i)},
          {RTCRayN_dir_x(rays, n, i), RTCRayN_dir_y(rays, n, i), RTCRayN_dir_z(rays, n, i)},
          RTCRayN_tfar(rays, n, i)};
}

void analytic_intersect_callback(const RTCIntersectFunctionNArguments* args) {
  const Shape& shape = *static_cast<const Shape*>(args->geometryUserPtr);
  const unsigned n = args->N;
  RTCRayN* const rays = RTCRayHitN_RayN(args->rayhit, n);
  RTCHitN* const hits = RTCRayHitN_HitN(args->rayhit, n);
  for (unsigned i = 0; i < n; ++i) {
    if (!args->valid[i]) continue;
    const Ray ray = ray_of(rays, n, i);
    double t[2];
    if (!intersect_analytic(shape, args->primID, ray, double(RTCRayN_tnear(rays, n, i)),
                            double(ray.tmax), t))
      continue;
    RTCRayN_tfar(rays, n, i) = float(t[0]);
    RTCHitN_u(hits, n, i) = RTCHitN_v(hits, n, i) = 0;
    RTCHitN_primID(hits, n, i) = args->primID;
    RTCHitN_geomID(hits, n, i) = args->geomID;
    RTCHitN_instID(hits, n, i, 0) = args->context->instID[0];
  }
}

void analytic_occluded_callback(const RTCOccludedFunctionNArguments* args) {
  const Shape& shape = *static_cast<const Shape*>(args->geometryUserPtr);
  const unsigned n = args->N;
  for (unsigned i = 0; i < n; ++i) {
    if (!args->valid[i]) continue;
    const Ray ray = ray_of(args->ray, n, i);
    double t[2];
    if (intersect_analytic(shape, args->primID, ray, double(RTCRayN_tnear(args->ray, n, i)),
                           double(ray.tmax), t))
      RTCRayN_tfar(args->ray, n, i) = -INFINITY;
  }
}

/// Lets rays through the inside of a tube.
void outside_only_callback(const RTCFilterFunctionNArguments* args) {
  if (args->N != 1 || !args->valid[0]) return;
  const auto& ray = *reinterpret_cast<const RTCRay*>(args->ray);
  const auto& hit = *reinterpret_cast<const RTCHit*>(args->hit);
  if (hit.Ng_x * ray.dir_x + hit.Ng_y * ray.dir_y + hit.Ng_z * ray.dir_z >= 0) args->valid[0] = 0;
}

RTCGeometry make_curve_geometry(RTCDevice device, const CurveSet& curves) {
  const bool ribbon = curves.profile != CurveProfile::tube;
  RTCGeometry g = rtcNewGeometry(device, ribbon ? RTC_GEOMETRY_TYPE_FLAT_BSPLINE_CURVE
                                         : curves.kind == CurveKind::bspline
                                             ? RTC_GEOMETRY_TYPE_ROUND_BSPLINE_CURVE
                                             : RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
  // Ribbons are intersected as chains of straight pieces: as many as there can be.
  if (ribbon) rtcSetGeometryTessellationRate(g, 16);
  static_assert(sizeof(TubePoint) == 4 * sizeof(float));
  rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, curves.points.data(),
                             0, sizeof(TubePoint), curves.points.size());
  rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, curves.segments.data(),
                             0, sizeof(uint32_t), curves.segments.size());
  if (curves.outside_only && !ribbon) {
    rtcSetGeometryIntersectFilterFunction(g, outside_only_callback);
    rtcSetGeometryOccludedFilterFunction(g, outside_only_callback);
  }
  return g;
}

RTCGeometry make_geometry(RTCDevice device, const Shape& shape) {
  if (shape.kind == ShapeKind::curves) return make_curve_geometry(device, *shape.curves);
  if (shape.kind != ShapeKind::mesh) {
    RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(g, shape.analytic_parts());
    rtcSetGeometryUserData(g, const_cast<Shape*>(&shape));
    rtcSetGeometryBoundsFunction(g, analytic_bounds_callback, nullptr);
    rtcSetGeometryIntersectFunction(g, analytic_intersect_callback);
    rtcSetGeometryOccludedFunction(g, analytic_occluded_callback);
    return g;
  }
  const TriangleMesh& m = *shape.mesh;
  RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  // Embree may read 4 bytes beyond the last vertex of a shared buffer: meshes for rendering reserve
  // them (scene/build_shapes.cpp).
  rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, m.positions.data(), 0,
                             sizeof(Point3f), m.positions.size());
  rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, m.triangles.data(), 0,
                             3 * sizeof(uint32_t), m.triangles.size());
  return g;
}

RTCScene make_scene(RTCDevice device) {
  RTCScene s = rtcNewScene(device);
  rtcSetSceneBuildQuality(s, RTC_BUILD_QUALITY_MEDIUM);
  return s;
}

void attach(RTCScene scene, RTCGeometry g, uint32_t id) {
  rtcCommitGeometry(g);
  rtcAttachGeometryByID(scene, g, id);
  rtcReleaseGeometry(g);
}

void place(RTCGeometry g, const Instance& instance) {
  rtcSetGeometryTransform(g, 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, instance.to_world.rows().data());
}

}  // namespace

struct Accel::Device {
  RTCDevice device = nullptr;
  std::vector<RTCScene> scenes;  ///< the top scene, then one per group
  ~Device() {
    for (RTCScene s : scenes) rtcReleaseScene(s);
    if (device) rtcReleaseDevice(device);
  }
};

Accel::Accel(const std::vector<Shape>& shapes, ShapeRange top,
             const std::vector<ShapeRange>& groups, const std::vector<Instance>& instances,
             int threads, AccelUse use)
    : device_(std::make_unique<Device>()),
      top_first_(top.first),
      top_count_(top.count),
      groups_(&groups),
      instances_(&instances) {
  device_->device = rtcNewDevice(fmt::format("threads={}", threads).c_str());
  if (!device_->device) throw std::runtime_error("Embree could not be started");
  RTCDevice device = device_->device;
  device_->scenes.push_back(make_scene(device));
  RTCScene scene = device_->scenes[0];
  if (use == AccelUse::moving) {
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_DYNAMIC);
    // A tree for each shape, still of medium quality, below one of all: the others are built anew.
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_LOW);
  }
  for (uint32_t i = 0; i < top.count; ++i)
    attach(scene, make_geometry(device, shapes[top.first + i]), i);
  for (const ShapeRange& group : groups) {
    RTCScene s = make_scene(device);
    device_->scenes.push_back(s);
    for (uint32_t i = 0; i < group.count; ++i)
      attach(s, make_geometry(device, shapes[group.first + i]), i);
    rtcCommitScene(s);
  }
  set_lead(shapes, top);
  choose_packets(shapes);
  for (uint32_t i = 0; i < instances.size(); ++i) {
    RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(g, device_->scenes[1 + instances[i].group]);
    rtcSetGeometryTimeStepCount(g, 1);
    place(g, instances[i]);
    attach(scene, g, top.count + i);
  }
  check(device, "to take over the geometry");
  rtcCommitScene(scene);
  check(device, "to build the acceleration structure");
  scene_ = scene;
}

Accel::~Accel() = default;

void Accel::set_lead(const std::vector<Shape>& shapes, ShapeRange top) {
  // Embree takes no notice of a ribbon within twice its radius from where a ray begins.
  const auto widest = [&](ShapeRange range) {
    float radius = 0;
    for (uint32_t i = range.first; i < range.first + range.count; ++i)
      if (shapes[i].kind == ShapeKind::curves && shapes[i].curves->profile != CurveProfile::tube)
        for (const TubePoint& p : shapes[i].curves->points) radius = std::max(radius, p.radius);
    return radius;
  };
  constexpr float kRadii = 2.5f;
  lead_ = kRadii * widest(top);
  std::vector<float> of_group;
  for (const ShapeRange& group : *groups_) of_group.push_back(widest(group));
  for (const Instance& i : *instances_)
    if (const float radius = of_group[i.group]; radius > 0)
      lead_ = std::max(lead_, kRadii * radius * i.scale);
}

void Accel::choose_packets(const std::vector<Shape>& shapes) {
  // Curves have filters and rays that begin elsewhere, which are made for one ray at a time. Where
  // analytic shapes are many, rays that part are slow in packets: each asks for other shapes.
  constexpr int kFewAnalyticShapes = 16;
  int analytic = 0;
  for (const Shape& shape : shapes) {
    if (shape.kind == ShapeKind::curves || shape.kind == ShapeKind::sdf_grid) return;
    analytic += shape.kind != ShapeKind::mesh;
  }
  if (analytic > kFewAnalyticShapes) return;
  const auto has = [&](RTCDeviceProperty p) {
    return rtcGetDeviceProperty(device_->device, p) != 0;
  };
  if (has(RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED))
    packet_ = 16;
  else if (has(RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED))
    packet_ = 8;
}

void Accel::update(std::span<const uint32_t> shapes, std::span<const uint32_t> instances) {
  RTCScene scene = device_->scenes[0];
  for (const uint32_t shape : shapes) {
    RTCGeometry g = rtcGetGeometry(scene, shape - top_first_);
    // Analytic shapes have no buffer, but are user data; a commit asks for their bounds.
    if (!rtcGetGeometryUserData(g)) rtcUpdateGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0);
    rtcCommitGeometry(g);
  }
  for (const uint32_t i : instances) {
    RTCGeometry g = rtcGetGeometry(scene, top_count_ + i);
    place(g, (*instances_)[i]);
    rtcCommitGeometry(g);
  }
  rtcCommitScene(scene);
  check(device_->device, "to follow what moves");
}

Bounds Accel::bounds() const {
  RTCBounds b;
  rtcGetSceneBounds(static_cast<RTCScene>(scene_), &b);
  Bounds out;
  if (b.lower_x <= b.upper_x) {
    out.lower = {b.lower_x, b.lower_y, b.lower_z};
    out.upper = {b.upper_x, b.upper_y, b.upper_z};
  }
  return out;
}

const char* embree_version() {
  return RTC_VERSION_STRING;
}

}  // namespace duet
