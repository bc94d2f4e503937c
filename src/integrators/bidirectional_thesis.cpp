// The eye sub-paths of the thesis beyond their limit.
#include "integrators/bidirectional_eye.h"
#include "integrators/next_event.h"

namespace duet {

void BidirectionalIntegrator::thesis_tail(const PathVertex& limit, Subpath& subpath,
                                          Eye<PathVertex>& eye) const {
  ++eye.counters.eye_subpaths_at_limit;
  const LightVertices& light = lights_.vertices();
  const bool light_end_connections =
      !light.ends.empty() && !light.subpath(eye.light_subpath).empty() &&
      int(light.subpath(eye.light_subpath).back().depth) == windows_.light;
  const bool specular = !limit.bsdf.has_smooth();
  if (!specular && (options_.weights == ReuseWeights::thesis_a || light_end_connections)) return;
  ++eye.counters.reused_subpaths;
  const SubpathOptions options{options_.rr_depth, options_.strict_normals};
  const Scene& scene = eye.scene;
  const PathVertex* v = &limit;
  std::optional<PathVertex> reached;
  for (int depth = limit.depth + 1; depth <= max_depth_; ++depth) {
    eye.sampler.start_dimension(kFirstVertexDimension + kDimensionsPerVertex * uint32_t(depth - 2) +
                                kScatteringDimension);
    if (!scatter<Transport::radiance>(*v, set_, options, eye.sampler, subpath)) return;
    Hit hit;
    ++eye.counters.closest_rays;
    if (!scene.accel->closest_hit(subpath.ray, hit)) {
      if (scene.environment)
        add(eye, 0, depth + 1,
            connect_escape(eye.connections(PathWeights(), options_.strict_normals), subpath));
      return;
    }
    ++eye.counters.path_vertices;
    const Surface s = scene.surface(subpath.ray, hit);
    if (s.shape->light != kNone)
      add(eye, 0, depth + 1,
          connect_hit(eye.connections(PathWeights(), options_.strict_normals), subpath, s,
                      hit.t * hit.t, depth));
    if (depth == max_depth_) return;
    reached.emplace(scene, s, -subpath.ray.direction, subpath.throughput, Partials{}, depth);
    v = &*reached;
    if (!v->bsdf.has_smooth() || scene.lights.empty()) continue;
    eye.sampler.start_dimension(kFirstVertexDimension + kDimensionsPerVertex * uint32_t(depth - 1));
    add(eye, 1, depth + 1,
        connect_light(eye.connections(PathWeights(), options_.strict_normals), *v, eye.sampler));
  }
}

}  // namespace duet
