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

  /// Calls `f(name, a's, b's)` for every counter.
  template <class A, class B, class F>
  static void for_each(A& a, B& b, const F& f) {
    f("closest_rays", a.closest_rays, b.closest_rays);
    f("shadow_rays", a.shadow_rays, b.shadow_rays);
    f("medium_steps", a.medium_steps, b.medium_steps);
    f("camera_paths", a.camera_paths, b.camera_paths);
    f("light_paths", a.light_paths, b.light_paths);
    f("path_vertices", a.path_vertices, b.path_vertices);
    f("nonfinite_samples", a.nonfinite_samples, b.nonfinite_samples);
    auto& ac = a.connections;
    auto& bc = b.connections;
    f("connections_contributed", ac.contributed, bc.contributed);
    f("connections_failed_specular", ac.failed_specular, bc.failed_specular);
    f("connections_failed_occluded", ac.failed_occluded, bc.failed_occluded);
    f("connections_failed_zero", ac.failed_zero, bc.failed_zero);
    f("connections_skipped", ac.skipped, bc.skipped);
    f("merge_queries", a.merge_queries, b.merge_queries);
    f("merges", a.merges, b.merges);
    f("eye_subpaths_at_limit", a.eye_subpaths_at_limit, b.eye_subpaths_at_limit);
    f("reused_subpaths", a.reused_subpaths, b.reused_subpaths);
  }
  void add(const RenderCounters& o) {
    for_each(*this, o, [](const char*, uint64_t& mine, uint64_t other) { mine += other; });
  }
};

}  // namespace duet
