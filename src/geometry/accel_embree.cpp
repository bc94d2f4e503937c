// Builds Embree's acceleration structures; accel_embree_queries.cpp asks them.
#include <fmt/format.h>

#include <stdexcept>

#include "base/thread_sanitizer.h"
#include "geometry/accel.h"
#include "geometry/embree.h"

namespace duet {

namespace {

void check(RTCDevice device, const char* doing) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return;
  throw std::runtime_error(
      fmt::format("Embree failed {}: {}", doing,
                  error == RTC_ERROR_OUT_OF_MEMORY ? "out of memory" : "internal error"));
}

/// Lets rays through the inside of a tube.
void outside_only_callback(const RTCFilterFunctionNArguments* args) {
  if (args->N != 1 || !args->valid[0]) return;
  const auto& ray = *reinterpret_cast<const RTCRay*>(args->ray);
  const auto& hit = *reinterpret_cast<const RTCHit*>(args->hit);
  if (hit.Ng_x * ray.dir_x + hit.Ng_y * ray.dir_y + hit.Ng_z * ray.dir_z >= 0) args->valid[0] = 0;
}

RTCGeometry make_tube_geometry(RTCDevice device, const CurveSet& curves) {
  RTCGeometry g = rtcNewGeometry(device, curves.kind == CurveKind::bspline
                                             ? RTC_GEOMETRY_TYPE_ROUND_BSPLINE_CURVE
                                             : RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
  static_assert(sizeof(TubePoint) == 4 * sizeof(float));
  rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, curves.points.data(),
                             0, sizeof(TubePoint), curves.points.size());
  rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, curves.segments.data(),
                             0, sizeof(uint32_t), curves.segments.size());
  if (curves.outside_only) {
    rtcSetGeometryIntersectFilterFunction(g, outside_only_callback);
    rtcSetGeometryOccludedFilterFunction(g, outside_only_callback);
  }
  return g;
}

RTCGeometry make_geometry(RTCDevice device, const Shape& shape) {
  if (shape.kind == ShapeKind::curves)
    return shape.curves->profile == CurveProfile::tube ? make_tube_geometry(device, *shape.curves)
                                                       : make_ribbon_geometry(device, shape);
  if (shape.kind != ShapeKind::mesh) return make_analytic_geometry(device, shape);
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
  std::vector<RTCScene> scenes;            ///< the top scene, then one per group
  std::unique_ptr<InstanceSet> instances;  ///< if they are many
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
  device_->device = rtcNewDevice(fmt::format("threads={}", kThreadSanitizer ? 1 : threads).c_str());
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
  choose_packets(shapes);
  attach_instances(use);
  check(device, "to take over the geometry");
  rtcCommitScene(scene);
  check(device, "to build the acceleration structure");
  scene_ = scene;
}

Accel::~Accel() = default;

void Accel::attach_instances(AccelUse use) {
  RTCDevice device = device_->device;
  RTCScene scene = device_->scenes[0];
  const std::vector<Instance>& instances = *instances_;
  if (use == AccelUse::still && instances.size() >= kManyInstances) {
    InstanceSet set{
        &instances, {device_->scenes.begin() + 1, device_->scenes.end()}, {}, top_count_};
    for (RTCScene group : set.scenes) set.bounds.push_back(bounds_of(group));
    device_->instances = std::make_unique<InstanceSet>(std::move(set));
    attach(scene, make_instances_geometry(device, *device_->instances), top_count_);
    return;
  }
  for (uint32_t i = 0; i < instances.size(); ++i) {
    RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(g, device_->scenes[1 + instances[i].group]);
    rtcSetGeometryTimeStepCount(g, 1);
    place(g, instances[i]);
    attach(scene, g, top_count_ + i);
  }
}

void Accel::choose_packets(const std::vector<Shape>& shapes) {
  // Curves have filters, which are made for one ray at a time, or are many. Where analytic shapes
  // are many, rays that part are slow in packets: each asks for other shapes.
  constexpr int kFewAnalyticShapes = 256;
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
    // Analytic shapes and ribbons have no buffer, but are user data; a commit asks for their
    // bounds.
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
  return bounds_of(static_cast<RTCScene>(scene_));
}

const char* embree_version() {
  return RTC_VERSION_STRING;
}

}  // namespace duet
