// Asks Embree for rays. Versions 3.13 and 4 differ in how per-ray arguments are passed.
#include <algorithm>

#include "geometry/accel.h"
#include "geometry/embree.h"

namespace duet {

bool Accel::closest_hit(const Ray& ray, Hit& hit) const {
  RTCRayHit rh;
  set_ray(rh.ray, ray);
  intersect_one(static_cast<RTCScene>(scene_), rh);
  if (rh.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  hit.t = rh.ray.tfar;
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
  set_ray(r, ray);
  occlude_one(static_cast<RTCScene>(scene_), r);
  return r.tfar < 0;
}

namespace {

template <int kWidth>
struct Packet;
template <>
struct Packet<8> {
  using Rays = RTCRay8;
  using RayHits = RTCRayHit8;
};
template <>
struct Packet<16> {
  using Rays = RTCRay16;
  using RayHits = RTCRayHit16;
};

/// Copies the rays from `first` on into a packet.
template <class Rays>
inline void set_rays(Rays& r, const RayBatch& rays, int first) {
  constexpr size_t kWidth = std::size(Rays{}.tfar);
  const auto copy = [&](float* to, const BatchArray<float>& from) {
    std::copy_n(&from[first], kWidth, to);
  };
  copy(r.org_x, rays.origin.x);
  copy(r.org_y, rays.origin.y);
  copy(r.org_z, rays.origin.z);
  copy(r.dir_x, rays.direction.x);
  copy(r.dir_y, rays.direction.y);
  copy(r.dir_z, rays.direction.z);
  copy(r.tfar, rays.tmax);
  std::fill_n(r.tnear, kWidth, 0.0f);
  std::fill_n(r.time, kWidth, 0.0f);
  std::fill_n(r.mask, kWidth, ~0u);
  std::fill_n(r.id, kWidth, 0u);
  std::fill_n(r.flags, kWidth, 0u);
}

/// Which rays of a packet are to be traced: the first `n`.
template <size_t kWidth>
inline void set_valid(int (&valid)[kWidth], int n) {
  for (size_t i = 0; i < kWidth; ++i) valid[i] = int(i) < n ? -1 : 0;
}

template <class RayHits>
inline void intersect(const int* valid, RTCScene scene, RayHits& rays) {
  constexpr bool kWide = std::is_same_v<RayHits, RTCRayHit16>;
#if RTC_VERSION_MAJOR >= 4
  if constexpr (kWide)
    rtcIntersect16(valid, scene, &rays);
  else
    rtcIntersect8(valid, scene, &rays);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  if constexpr (kWide)
    rtcIntersect16(valid, scene, &context, &rays);
  else
    rtcIntersect8(valid, scene, &context, &rays);
#endif
}

template <class Rays>
inline void occlude(const int* valid, RTCScene scene, Rays& rays) {
  constexpr bool kWide = std::is_same_v<Rays, RTCRay16>;
#if RTC_VERSION_MAJOR >= 4
  if constexpr (kWide)
    rtcOccluded16(valid, scene, &rays);
  else
    rtcOccluded8(valid, scene, &rays);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  if constexpr (kWide)
    rtcOccluded16(valid, scene, &context, &rays);
  else
    rtcOccluded8(valid, scene, &context, &rays);
#endif
}

}  // namespace

template <int kWidth>
void Accel::intersect_packets(const RayBatch& rays, int n, HitBatch& hits) const {
  for (int first = 0; first < n; first += kWidth) {
    alignas(64) typename Packet<kWidth>::RayHits packet;
    alignas(64) int valid[kWidth];
    set_valid(valid, n - first);
    set_rays(packet.ray, rays, first);
    std::fill_n(packet.hit.geomID, kWidth, RTC_INVALID_GEOMETRY_ID);
    std::fill_n(packet.hit.instID[0], kWidth, RTC_INVALID_GEOMETRY_ID);
    intersect(valid, static_cast<RTCScene>(scene_), packet);
    std::copy_n(packet.ray.tfar, kWidth, &hits.t[first]);
    std::copy_n(packet.hit.u, kWidth, &hits.u[first]);
    std::copy_n(packet.hit.v, kWidth, &hits.v[first]);
    std::copy_n(packet.hit.primID, kWidth, &hits.primitive[first]);
    for (int i = 0; i < kWidth; ++i) {
      const unsigned shape = packet.hit.geomID[i], instance = packet.hit.instID[0][i];
      hits.shape[first + i] = shape == RTC_INVALID_GEOMETRY_ID ? kNone : top_first_ + shape;
      hits.instance[first + i] = instance == RTC_INVALID_GEOMETRY_ID ? kNone : instance;
    }
    if (instances_->empty()) continue;
    for (int i = first; i < std::min(first + kWidth, n); ++i) {
      if (hits.shape[i] == kNone || hits.instance[i] == kNone) continue;
      hits.instance[i] -= top_count_;
      hits.shape[i] += (*groups_)[(*instances_)[hits.instance[i]].group].first - top_first_;
    }
  }
}

template <int kWidth>
void Accel::occlude_packets(const RayBatch& rays, int n, BatchArray<int32_t>& blocked) const {
  for (int first = 0; first < n; first += kWidth) {
    alignas(64) typename Packet<kWidth>::Rays packet;
    alignas(64) int valid[kWidth];
    set_valid(valid, n - first);
    set_rays(packet, rays, first);
    occlude(valid, static_cast<RTCScene>(scene_), packet);
    for (int i = 0; i < kWidth; ++i) blocked[first + i] = packet.tfar[i] < 0;
  }
}

void Accel::closest_hits(const RayBatch& rays, int n, HitBatch& hits) const {
  if (packet_ == 16) return intersect_packets<16>(rays, n, hits);
  if (packet_ == 8) return intersect_packets<8>(rays, n, hits);
  for (int i = 0; i < n; ++i) {
    Hit hit{};
    if (!closest_hit(rays[i], hit)) hit.shape = kNone;
    hits.t[i] = hit.t, hits.u[i] = hit.u, hits.v[i] = hit.v;
    hits.primitive[i] = hit.primitive, hits.shape[i] = hit.shape, hits.instance[i] = hit.instance;
  }
}

void Accel::occluded(const RayBatch& rays, int n, BatchArray<int32_t>& blocked) const {
  if (packet_ == 16) return occlude_packets<16>(rays, n, blocked);
  if (packet_ == 8) return occlude_packets<8>(rays, n, blocked);
  for (int i = 0; i < n; ++i) blocked[i] = occluded(rays[i]);
}

}  // namespace duet
