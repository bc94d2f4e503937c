// The densities of all vertices of a sub-path, for weights that need more than running sums.
#pragma once

#include <vector>

namespace duet {

struct VertexPdfs {
  float forward;  ///< area density with which this sub-path made the vertex; per volume in media
  float reverse;  ///< the same for a sub-path from the other end; set on leaving the next vertex
  float back;     ///< |cos| at the previous vertex over the squared distance: what makes a density
                  ///< per solid angle here one per area there (media: see arrive() in mis.h)
  bool specular;  ///< left by a delta lobe
  bool merges = false;  ///< photons are merged there
};

/// Vertex 0 is on the light or on the lens; only those between them have all entries.
using SubpathPdfs = std::vector<VertexPdfs>;

/// What the vertex pdfs of a light sub-path had at its ends when the sub-path was at a vertex:
/// where a sub-path goes straight on, another vertex takes the place of the last.
struct EndPdfs {
  VertexPdfs light, vertex;
};

}  // namespace duet
