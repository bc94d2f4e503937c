// The stages of batches of sub-paths, from the camera or from the lights.
#pragma once

#include "integrators/wide_stages.h"
#include "integrators/wide_subpaths.h"
#include "transport/subpath.h"

namespace duet {

/// What sub-paths do at their vertices beside what paths do: they carry the sums of multiple
/// importance sampling along, and bind the BSDFs of materials that have no loops of their own as
/// vertices ("special" here).
class WideSubpathStages : protected WideStages {
 protected:
  WideSubpathStages(const WideScene& scene, const PathLimits& limits, Transport transport)
      : WideStages(scene, limits, transport) {
    vertices_.reserve(kBatch);
  }

  void fill_gaps();
  /// Binds the BSDFs of WideModel::other and evaluates them for the directions of `lights_`.
  void make_special_vertices(int n, int depth);
  /// From there, the next directions.
  void scatter_special_vertices();
  /// The special vertex of a point, or null.
  PathVertex* special_vertex(int i) {
    return vertex_of_[i] >= 0 && vertex_of_[i] < special_vertices_
               ? &vertices_[size_t(vertex_of_[i])]
               : nullptr;
  }
  Partials partials(int i) const { return {subpaths_.vcm[i], subpaths_.vc[i], subpaths_.vm[i]}; }
  /// Whether a sub-path goes on: arrive() ends those that arrive along the surface.
  bool carries(int i) const { return throughput(i).max() > 0; }
  /// Whether a point that is not special scatters anything.
  bool is_smooth(int i) const;

  WideSubpaths subpaths_{};
  WideEnds ends_{};
  /// Vertices of the sub-paths at this depth: first the special ones, then others that were needed
  /// as such. Never more than there is room for.
  std::vector<PathVertex> vertices_;
  int special_vertices_ = 0;
  BatchArray<int32_t> vertex_of_{};  ///< numbers of the vertices, or −1
};

}  // namespace duet
