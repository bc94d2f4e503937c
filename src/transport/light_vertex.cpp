#include "transport/light_vertex.h"

#include <array>
#include <bit>

namespace duet {

namespace {

constexpr double kScale = 2147483647.0;

uint32_t quantize(float x) {
  return uint32_t(int32_t(std::clamp(double(x), -1.0, 1.0) * kScale));
}
float restore(uint32_t q) {
  return float(int32_t(q)) * float(1 / kScale);
}
uint16_t quantize_unit(float x) {
  return uint16_t(std::clamp(x, 0.0f, 1.0f) * 65535.0f + 0.5f);
}

}  // namespace

LightVertex::LightVertex(const PathVertex& v, const Hit& hit)
    : position(v.surface.position),
      throughput(v.throughput),
      partials(v.partials),
      shape(hit.shape),
      primitive(hit.primitive),
      instance(hit.instance),
      barycentric{0, 0},
      depth(uint16_t(v.depth)),
      merges(v.merges()) {
  if (const ShapeKind kind = v.surface.shape->kind;
      kind == ShapeKind::mesh || kind == ShapeKind::curves) {
    barycentric[0] = quantize_unit(v.surface.barycentric.x);
    barycentric[1] = quantize_unit(v.surface.barycentric.y);
  }
  set_direction_to_previous(v.wo);
}

LightVertex::LightVertex(const MediaVertex& v, const Hit& hit) {
  if (!v.in_medium) {
    *this = LightVertex(static_cast<const PathVertex&>(v), hit);
    return;
  }
  position = v.position();
  throughput = v.throughput;
  partials = v.partials;
  shape = kNone;
  static_assert(sizeof(const Medium*) == sizeof(primitive) + sizeof(instance));
  const auto address = std::bit_cast<std::array<uint32_t, 2>>(v.medium);
  primitive = address[0], instance = address[1];
  barycentric[0] = barycentric[1] = 0;
  depth = uint16_t(v.depth);
  merges = false;
  set_direction_to_previous(v.wo);
}

// The direction as a point of the octahedron |x| + |y| + |z| = 1, its lower half folded over the
// upper. Source: Cigolle et al., "A Survey of Efficient Representations for Independent Unit
// Vectors", JCGT 3(2), 2014.
void LightVertex::set_direction_to_previous(const Vector3f& v) {
  const Vector3f w = v / (std::abs(v.x) + std::abs(v.y) + std::abs(v.z));
  const float x = w.z < 0 ? std::copysign(1 - std::abs(w.y), w.x) : w.x;
  const float y = w.z < 0 ? std::copysign(1 - std::abs(w.x), w.y) : w.y;
  wo[0] = quantize(x), wo[1] = quantize(y);
}

Vector3f LightVertex::direction_to_previous() const {
  const float x = restore(wo[0]), y = restore(wo[1]);
  const float z = 1 - std::abs(x) - std::abs(y);
  if (z >= 0) return normalize(Vector3f(x, y, z));
  return normalize(
      Vector3f(std::copysign(1 - std::abs(y), x), std::copysign(1 - std::abs(x), y), z));
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
  return PathVertex(scene, surface(scene, towards_previous), towards_previous, throughput, partials,
                    int(depth));
}

template <>
MediaVertex LightVertex::unpack(const Scene& scene) const {
  const Vector3f towards_previous = direction_to_previous();
  if (!in_medium())
    return MediaVertex(scene, surface(scene, towards_previous), towards_previous,
                       {throughput, partials, int(depth)}, nullptr);
  const Medium& medium =
      *std::bit_cast<const Medium*>(std::array<uint32_t, 2>{primitive, instance});
  return MediaVertex({medium, medium.nominal_extinction(position), position}, towards_previous,
                     {throughput, partials, int(depth)});
}

}  // namespace duet
