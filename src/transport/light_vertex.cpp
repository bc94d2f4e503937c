#include "transport/light_vertex.h"

#include <array>
#include <bit>

namespace duet {

namespace {

uint32_t quantize(float x) {
  return uint32_t(int32_t(std::clamp(double(x), -1.0, 1.0) * kOctahedronScale));
}
uint16_t quantize_unit(float x) {
  return uint16_t(std::clamp(x, 0.0f, 1.0f) * 65535.0f + 0.5f);
}

/// Cosines below it are rounding: nothing arrives.
constexpr float kLeastCosine = 1e-6f;

/// Where nothing is interpolated, zero.
Point2f barycentric_of(const Surface& s) {
  const ShapeKind kind = s.shape->kind;
  return kind == ShapeKind::mesh || kind == ShapeKind::curves ? s.barycentric : Point2f{};
}

}  // namespace

LightVertex::LightVertex(const SurfaceArrival& a, const Hit& hit)
    : position(a.position),
      arriving(a.cosine > kLeastCosine ? a.throughput / a.cosine : Spectrum()),
      partials(a.partials),
      shape(hit.shape),
      primitive(hit.primitive),
      instance(hit.instance),
      barycentric{quantize_unit(a.barycentric.x), quantize_unit(a.barycentric.y)},
      depth(uint16_t(a.depth)),
      merges(a.merges) {
  set_light_sample({});
  set_direction_to_previous(a.wo);
}

LightVertex::LightVertex(const PathVertex& v, const Hit& hit)
    : LightVertex({v.surface.position, v.wo, v.cosine(v.wo), v.throughput, v.partials, v.depth,
                   v.merges(), barycentric_of(v.surface)},
                  hit) {
  set_light_sample(v.light_sample);
}

LightVertex::LightVertex(const MediaVertex& v, const Hit& hit) {
  if (!v.in_medium) {
    *this = LightVertex(static_cast<const PathVertex&>(v), hit);
    return;
  }
  position = v.position();
  arriving = v.throughput;
  partials = v.partials;
  shape = kNone;
  static_assert(sizeof(const Medium*) == sizeof(primitive) + sizeof(instance));
  const auto address = std::bit_cast<std::array<uint32_t, 2>>(v.medium);
  primitive = address[0], instance = address[1];
  barycentric[0] = barycentric[1] = 0;
  depth = uint16_t(v.depth);
  merges = false;
  set_light_sample({});
  set_direction_to_previous(v.wo);
}

// See decode_direction().
void LightVertex::set_direction_to_previous(const Vector3f& v) {
  const Vector3f w = v / (std::abs(v.x) + std::abs(v.y) + std::abs(v.z));
  const float x = w.z < 0 ? std::copysign(1 - std::abs(w.y), w.x) : w.x;
  const float y = w.z < 0 ? std::copysign(1 - std::abs(w.x), w.y) : w.y;
  wo[0] = quantize(x), wo[1] = quantize(y);
}

inline Surface LightVertex::surface(const Scene& scene, const Vector3f& towards_previous) const {
  const Hit hit{0,
                float(barycentric[0]) * (1 / 65535.0f),
                float(barycentric[1]) * (1 / 65535.0f),
                primitive,
                shape,
                instance};
  Surface s = scene.surface({position, -towards_previous, 0}, hit);
  s.position = position;
  return s;
}

template <>
PathVertex LightVertex::unpack(const Scene& scene) const {
  const Vector3f towards_previous = direction_to_previous();
  const Surface s = surface(scene, towards_previous);
  return PathVertex(scene, s, towards_previous, throughput(s.ng), partials, int(depth));
}

template <>
MediaVertex LightVertex::unpack(const Scene& scene) const {
  const Vector3f towards_previous = direction_to_previous();
  if (!in_medium()) {
    const Surface s = surface(scene, towards_previous);
    return MediaVertex(scene, s, towards_previous, {throughput(s.ng), partials, int(depth)},
                       nullptr);
  }
  const Medium& medium =
      *std::bit_cast<const Medium*>(std::array<uint32_t, 2>{primitive, instance});
  return MediaVertex({medium, medium.nominal_extinction(position), position}, towards_previous,
                     {arriving, partials, int(depth)});
}

}  // namespace duet
