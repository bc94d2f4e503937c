#include "integrators/method_costs.h"

namespace duet {

// In proportion to the CPU times that bench/auto_costs.py measures, mostly within a quarter.

// Mostly within a half: batches are fastest where surfaces are diffuse and the light is one
// rectangle, which counts do not tell.
double path_cost(const WorkPerSample& w) {
  return 0.035 + 0.124 * w.eye_rays + 0.09 * w.light_samples;
}

double pixel_group_cost(double shadow_rays) {
  return 0.1 + 0.03 * shadow_rays;
}

double volpath_cost(const WorkPerSample& w) {
  return 0.05 + 0.18 * w.eye_rays + 0.13 * w.light_samples + 0.05 * w.medium_steps;
}

double bidirectional_cost(const WorkPerSample& w) {
  return 0.05 + 0.22 * w.eye_rays + 0.25 * w.light_samples + 0.19 * w.light_rays +
         0.08 * w.camera_rays + 0.05 * w.connections + 0.08 * w.connection_rays +
         0.20 * w.merge_queries + 0.05 * w.merges + 0.10 * w.stored_vertices +
         0.05 * w.medium_steps;
}

// Within a quarter, too, mostly. Relative errors alone do not tell factors apart whose counts grow
// together: these are the least that such errors and relative changes of rough guesses add up to.
double batched_cost(const WorkPerSample& w) {
  return 0.14 + 0.16 * w.eye_rays + 0.10 * w.light_samples + 0.26 * w.light_rays +
         0.07 * w.camera_rays + 0.013 * w.connections + 0.04 * w.connection_rays +
         0.17 * w.merge_queries + 0.037 * w.merges + 0.065 * w.stored_vertices;
}

}  // namespace duet
