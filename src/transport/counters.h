// What happened while rendering, for statistics.
#pragma once

#include <cstdint>

namespace duet {

/// Attempts to connect an eye vertex with a light vertex, by how they ended.
struct ConnectionCounters {
  uint64_t contributed = 0;
  uint64_t failed_specular = 0;  ///< one of the two scatters into single directions only
  uint64_t failed_occluded = 0;
  uint64_t failed_zero = 0;  ///< a BSDF, or a cosine, is zero
  uint64_t skipped = 0;      ///< would have added so little that roulette ended them
  uint64_t attempted() const {
    return contributed + failed_specular + failed_occluded + failed_zero + skipped;
  }
};

struct RenderCounters {
  uint64_t closest_rays = 0, shadow_rays = 0;
  /// Stretches of rays through media, and the random numbers that were drawn for them: of those
  /// that are looked up in grids every step takes one or two.
  uint64_t medium_steps = 0;
  uint64_t camera_paths = 0, light_paths = 0;
  uint64_t path_vertices = 0;  ///< of camera paths
  uint64_t nonfinite_samples = 0;
  ConnectionCounters connections;
  uint64_t merge_queries = 0, merges = 0;  ///< merges that contributed
  uint64_t eye_subpaths_at_limit = 0, reused_subpaths = 0;

  void add(const RenderCounters& o) {
    closest_rays += o.closest_rays;
    shadow_rays += o.shadow_rays;
    medium_steps += o.medium_steps;
    camera_paths += o.camera_paths;
    light_paths += o.light_paths;
    path_vertices += o.path_vertices;
    nonfinite_samples += o.nonfinite_samples;
    connections.contributed += o.connections.contributed;
    connections.failed_specular += o.connections.failed_specular;
    connections.failed_occluded += o.connections.failed_occluded;
    connections.failed_zero += o.connections.failed_zero;
    connections.skipped += o.connections.skipped;
    merge_queries += o.merge_queries;
    merges += o.merges;
    eye_subpaths_at_limit += o.eye_subpaths_at_limit;
    reused_subpaths += o.reused_subpaths;
  }
};

}  // namespace duet
