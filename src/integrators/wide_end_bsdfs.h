// What the vertices at one end of many connections or merges scatter.
#pragma once

#include "integrators/wide_scene.h"
#include "integrators/wide_subpaths.h"

namespace duet {

/// What the vertices at one end of pairs make of the directions to the other ends.
struct EndBsdfs {
  BatchArray<int32_t> material;  ///< WideShape::pair_list(); of diffuse ones nothing is evaluated
  BatchArray<int32_t> at;        ///< the vertex
  BatchTriples towards;          ///< unit, to the other end
  BatchTriples value;            ///< of the BSDF
  BatchArray<float> pdf, reverse;
};

/// What a vertex makes of a direction: its BSDF times the throughput, and densities.
struct Scattered {
  float r, g, b, pdf, reverse;
};
/// A diffuse vertex and a unit direction.
[[gnu::always_inline]] inline Scattered scattered_diffusely(const WideEnds& ends, int i,
                                                            const Vector3f& towards) {
  const float pdf = std::max(0.0f, dot(ends.lit.vector(i), towards) * kInvPi);
  return {ends.flux.x[i] * pdf, ends.flux.y[i] * pdf, ends.flux.z[i] * pdf, pdf, ends.reverse[i]};
}
/// A glossy vertex of pair k; `throughput` is entry i.
[[gnu::always_inline]] inline Scattered scattered(const EndBsdfs& f, int k,
                                                  const BatchTriples& throughput, int i) {
  return {throughput.x[i] * f.value.x[k], throughput.y[i] * f.value.y[k],
          throughput.z[i] * f.value.z[k], f.pdf[k], f.reverse[k]};
}

/// Evaluates pairs of many materials, material after material, so that each has one loop.
class EvaluateEnds {
 public:
  /// The materials must outlive this.
  explicit EvaluateEnds(const std::vector<WideGlossyMaterial>& materials)
      : materials_(materials), ends_(materials.size() + 1) {}

  /// Of `n` pairs; `vertices` are those that EndBsdfs::at counts.
  void evaluate(int n, const WideVertices& vertices, EndBsdfs& ends);

 private:
  const std::vector<WideGlossyMaterial>& materials_;
  std::vector<int> ends_;        ///< of the pairs of each material in `order_`
  BatchArray<int32_t> order_{};  ///< pairs by material
  WideGlossy glossy_{};
};

}  // namespace duet
