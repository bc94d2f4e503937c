// Vertices of light sub-paths in the form in which millions of them are kept.
#pragma once

#include <vector>

#include "transport/media_vertex.h"

namespace duet {

/// What stands for a coordinate of 1 on an octahedron.
inline constexpr double kOctahedronScale = 2147483647.0;
/// A unit vector of its place on the octahedron |x| + |y| + |z| = 1, whose lower half is folded
/// over the upper: 32 bits per coordinate, in two's complement. Source: Cigolle et al., "A Survey
/// of Efficient Representations for Independent Unit Vectors", JCGT 3(2), 2014.
[[gnu::always_inline]] inline Vector3f decode_direction(uint32_t u, uint32_t v) {
  constexpr auto unit = float(1 / kOctahedronScale);
  const float x = float(int32_t(u)) * unit, y = float(int32_t(v)) * unit;
  const float z = 1 - std::abs(x) - std::abs(y);
  const float folded_x = std::copysign(1 - std::abs(y), x),
              folded_y = std::copysign(1 - std::abs(x), y);
  return normalize(Vector3f(z < 0 ? folded_x : x, z < 0 ? folded_y : y, z));
}

/// How a light sub-path arrives at a surface.
struct SurfaceArrival {
  Point3f position;
  Vector3f wo;   ///< unit, towards the previous vertex
  float cosine;  ///< of it with the geometric normal, without sign
  Spectrum throughput;
  Partials partials;
  int depth;
  bool merges;          ///< PathVertex::merges()
  Point2f barycentric;  ///< of triangles and curves
};

/// A vertex of a light sub-path, packed: its BSDF is bound again when it is needed. In a medium
/// `shape` is kNone and the address of the medium stands in place of the primitive and the
/// instance.
struct LightVertex {
  Point3f position;
  /// The throughput, on a surface over the cosine of the direction back with the geometric normal:
  /// photons are counted per area of the surface on which they are, and near by it may face
  /// another way.
  Spectrum arriving;
  Partials partials;
  uint32_t shape, primitive, instance;
  uint32_t wo[2];           ///< octahedral, 32 bits per coordinate
  uint16_t barycentric[2];  ///< for what is interpolated; the position is exact
  uint16_t depth;
  uint8_t merges : 1;  ///< whether photons are merged there
  // PathVertex::light_sample.
  uint8_t light_distance : LightSampleVariance::kDistanceBits;
  uint8_t other_lights;

  LightVertex() = default;
  LightVertex(const SurfaceArrival& a, const Hit& hit);
  LightVertex(const PathVertex& v, const Hit& hit);
  LightVertex(const MediaVertex& v, const Hit& hit);

  Vector3f direction_to_previous() const { return decode_direction(wo[0], wo[1]); }
  bool in_medium() const { return shape == kNone; }
  /// At a point of a surface with this normal.
  Spectrum throughput(const Normal3f& ng) const {
    return arriving * std::abs(dot(ng, direction_to_previous()));
  }
  void set_light_sample(const LightSampleVariance& v) {
    light_distance = v.distance & ((1 << LightSampleVariance::kDistanceBits) - 1);
    other_lights = v.others;
  }
  /// For how many a light sample in its place counts; see LightSampleVariance::gain().
  float light_sample_gain(float pixel_area) const {
    return LightSampleVariance::gain(other_lights, light_distance, pixel_area);
  }
  /// As a merge with an eye vertex sees them that lies behind so many segments.
  Partials partials_below(int eye_depth, float pixel_area) const {
    const float gain = eye_depth == 1 ? light_sample_gain(pixel_area) : 1.0f;
    return {gain * partials.vcm, gain * partials.vc, gain * partials.vm};
  }
  /// `Vertex` is the kind of vertex that was packed. What the segment towards the light went
  /// through is not kept on surfaces.
  template <class Vertex = PathVertex>
  Vertex unpack(const Scene& scene) const;

 private:
  void set_direction_to_previous(const Vector3f& w);
  Surface surface(const Scene& scene, const Vector3f& towards_previous) const;
};
static_assert(sizeof(LightVertex) == 64);

/// Converts to the vertex in the place where it is wanted: to copy one, with room for the largest
/// BSDF, costs more than to make it.
template <class Vertex>
struct Unpacked {
  const LightVertex& vertex;
  const Scene& scene;
  operator Vertex() const { return vertex.unpack<Vertex>(scene); }
};

/// The connectible vertices of many light sub-paths, sub-path after sub-path.
struct LightVertices {
  std::vector<LightVertex> vertices;
  /// Sub-path i owns the vertices [ends[i − 1], ends[i]).
  std::vector<uint32_t> ends;
  /// All vertices that each sub-path had, also those that cannot be connected.
  std::vector<uint16_t> lengths;

  void clear() { vertices.clear(), ends.clear(), lengths.clear(); }
  std::span<const LightVertex> subpath(size_t i) const { return part_of(vertices, i); }
  /// The part of a list with an entry for every vertex that belongs to sub-path i.
  template <class T>
  std::span<const T> part_of(const std::vector<T>& list, size_t i) const {
    return {list.data() + first(i), ends[i] - first(i)};
  }
  uint32_t first(size_t i) const { return i == 0 ? 0 : ends[i - 1]; }
};

}  // namespace duet
