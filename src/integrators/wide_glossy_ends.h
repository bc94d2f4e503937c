// The glossy vertices at one end of many connections.
#pragma once

#include "integrators/wide_glossy.h"
#include "integrators/wide_scene.h"

namespace duet {

/// What the vertices at one end of pairs make of the directions to the other ends.
struct EndBsdfs {
  BatchArray<int32_t> material;  ///< WideShape::pair_list(); of diffuse ones nothing is evaluated
  BatchArray<int32_t> at;        ///< the vertex
  BatchTriples towards;          ///< unit, to the other end
  BatchTriples value;            ///< of the BSDF
  BatchArray<float> pdf, reverse;
};

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
