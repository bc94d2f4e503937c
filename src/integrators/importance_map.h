// How much light on a surface matters to the image: a rough estimate from a few camera sub-paths.
#pragma once

#include <span>
#include <vector>

#include "scene/scene.h"
#include "transport/subpath.h"

namespace duet {

/// A vertex of a camera sub-path.
struct Importon {
  Point3f position;
  Vector3f normal;  ///< unit, to where the sub-path came from; zero where both sides matter
  float weight;     ///< what radiance that leaves it counts for the image, at most 1
  bool is_smooth;   ///< whether photons could be merged with it
};

/// The vertices of `side`² camera sub-paths, spread over an image of this size, with up to
/// `max_depth` segments. The scene has no media. The result does not depend on `threads`.
std::vector<Importon> trace_importons(const Scene& scene, Point2i film, int side, int max_depth,
                                      const SubpathOptions& options, int threads);

/// A tree of boxes around importons that are near and face the same way.
class ImportanceMap {
 public:
  /// Of those that are smooth.
  explicit ImportanceMap(std::vector<Importon> importons);

  /// Importance per area of light that comes from the unit direction `wi` to a point; zero where no
  /// camera sub-path has been.
  float operator()(const Point3f& p, const Vector3f& wi) const;

 private:
  struct Node {
    Point3f low, high;
    Vector3f normal;    ///< mean of the importons'
    float importance;   ///< of a leaf, per area
    uint32_t skip = 0;  ///< the node after this one and all below it
    bool is_leaf = false;
  };
  void build(std::span<Importon> importons, float normal_scale);

  std::vector<Node> nodes_;
};

}  // namespace duet
