// The densities of all vertices of a walk, for weights that need more than running sums.
#pragma once

#include <vector>

namespace duet {

struct TrailVertex {
  float forward;  ///< area density with which this walk made the vertex; per volume in media
  float reverse;  ///< the same for a walk from the other end; set on leaving the next vertex
  float back;     ///< |cos| at the previous vertex over the squared distance: what makes a density
                  ///< per solid angle here one per area there (media: see arrive() in mis.h)
  bool specular;  ///< left by a delta lobe
  bool merges = false;  ///< photons are merged there
};

/// Vertex 0 is on the light or on the lens; only those between them have all entries.
using Trail = std::vector<TrailVertex>;

/// What the trail of a light walk had at its ends when the walk was at a vertex: where a walk goes
/// straight on, another vertex takes the place of the last.
struct TrailEnds {
  TrailVertex light, vertex;
};

}  // namespace duet
