// Weights by their definition: the densities of a path's vertices from both ends, evaluated anew at
// every vertex, and the sum over all techniques.
#pragma once

#include <functional>

#include "transport/window_weights.h"

namespace duet::test {

/// A whole path x_0 … x_k, without its end on the light (which densities per solid angle at x_1
/// stand for) and on the lens.
struct OraclePath {
  std::vector<Surface> surfaces;  ///< x_1 … x_{k-1}; of a point in a medium the position only
  /// The medium that x_i lies in, null for points of surfaces; and the nominal transmittance
  /// between x_i and x_{i+1}, from i = 0. Both are empty where there are no media.
  std::vector<const Medium*> media;
  std::vector<double> transmittance;
  std::vector<bool> specular;  ///< whether x_i scattered by a delta lobe
  std::vector<double> eta;     ///< index on the eye's side over that on the light's
  Vector3f to_light, to_lens;  ///< unit, from x_1 and from x_{k-1}
  bool light_can_be_hit = true;
  double direct = 0;          ///< density of light samples at x_1, per solid angle
  double choice = 0;          ///< probability with which a light sample at x_1 chooses the light
  bool is_light_near = true;  ///< or infinitely far away
  double gain = 1;            ///< how often hits and light samples count if there are two segments
  double emission = 0;        ///< EmissionSample::density with the probability of the light
  double importance = 0;      ///< Camera::importance at x_{k-1}
  int segments() const { return int(surfaces.size()) + 1; }
};

/// How many samples a technique takes; 0 if the method does not have it.
using Shares = std::function<double(int s, int t)>;
/// For merges at x_i: samples, or 0.
using MergeShares = std::function<double(int i)>;

/// n_s p_s for s = 0 … k, up to a common factor, then those of merges at x_1 … x_{k-1}.
/// The factor is chosen such that nothing overflows.
std::vector<double> technique_densities(const Scene& scene, const OraclePath& path,
                                        const Shares& shares, double merge_area,
                                        const MergeShares& merges);

}  // namespace duet::test
