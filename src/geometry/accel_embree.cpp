// The only file that knows Embree. Versions 3.13 and 4 differ in how per-ray arguments are passed.
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

Ray to_ray(const RTCRay& r) {
  return {{r.org_x, r.org_y, r.org_z}, {r.dir_x, r.dir_y, r.dir_z}, r.tfar};
}

void analytic_intersect_callback(const RTCIntersectFunctionNArguments* args) {
  if (args->N != 1 || !args->valid[0]) return;
  auto* ray_hit = reinterpret_cast<RTCRayHit*>(args->rayhit);
  const Shape& shape = *static_cast<const Shape*>(args->geometryUserPtr);
  double t[2];
  if (!intersect_analytic(shape, args->primID, to_ray(ray_hit->ray), ray_hit->ray.tnear,
                          ray_hit->ray.tfar, t))
    return;
  ray_hit->ray.tfar = float(t[0]);
  ray_hit->hit.u = ray_hit->hit.v = 0;
  ray_hit->hit.primID = args->primID;
  ray_hit->hit.geomID = args->geomID;
  ray_hit->hit.instID[0] = args->context->instID[0];
}

void analytic_occluded_callback(const RTCOccludedFunctionNArguments* args) {
  if (args->N != 1 || !args->valid[0]) return;
  auto* ray = reinterpret_cast<RTCRay*>(args->ray);
  const Shape& shape = *static_cast<const Shape*>(args->geometryUserPtr);
  double t[2];
  if (intersect_analytic(shape, args->primID, to_ray(*ray), ray->tnear, ray->tfar, t))
    ray->tfar = -INFINITY;
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

namespace {

/// `lead`: Accel::lead_.
inline void set_ray(RTCRay& r, const Ray& ray, float lead) {
  // Embree reads origin and direction as vectors of four: what is written piece by piece and read
  // as a whole has to wait until it has left the store buffer.
  using Four [[gnu::vector_size(16), gnu::may_alias]] = float;
  *reinterpret_cast<Four*>(&r.org_x) = Four{ray.origin.x, ray.origin.y, ray.origin.z, 0};
  *reinterpret_cast<Four*>(&r.dir_x) = Four{ray.direction.x, ray.direction.y, ray.direction.z, 0};
  r.tfar = ray.tmax;
  if (lead > 0) {
    const Point3f origin = ray.origin - ray.direction * lead;
    *reinterpret_cast<Four*>(&r.org_x) = Four{origin.x, origin.y, origin.z, lead};
    r.tfar += lead;
  }
  r.mask = ~0u, r.id = 0, r.flags = 0;
}

}  // namespace

bool Accel::closest_hit(const Ray& ray, Hit& hit) const {
  RTCRayHit rh;
  set_ray(rh.ray, ray, lead_);
  rh.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rh.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
  rtcIntersect1(static_cast<RTCScene>(scene_), &rh);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(static_cast<RTCScene>(scene_), &context, &rh);
#endif
  if (rh.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  hit.t = rh.ray.tfar - lead_;
  hit.u = rh.hit.u;
  hit.v = rh.hit.v;
  hit.primitive = rh.hit.primID;
  if (rh.hit.instID[0] == RTC_INVALID_GEOMETRY_ID) {
    hit.shape = top_first_ + rh.hit.geomID;
    hit.instance = kNone;
  } else {
    hit.instance = rh.hit.instID[0] - top_count_;
    hit.shape = (*groups_)[(*instances_)[hit.instance].group].first + rh.hit.geomID;
  }
  return true;
}

bool Accel::occluded(const Ray& ray) const {
  RTCRay r;
  set_ray(r, ray, lead_);
#if RTC_VERSION_MAJOR >= 4
  rtcOccluded1(static_cast<RTCScene>(scene_), &r);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(static_cast<RTCScene>(scene_), &context, &r);
#endif
  return r.tfar < 0;
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
