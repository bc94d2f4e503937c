#include "integrators/method_costs.h"

namespace duet {

// In proportion to the CPU times that bench/auto_costs.py measures, within about a third.
double path_cost(const WorkPerSample& w) {
  return 0.15 + 0.20 * w.eye_rays + 0.10 * w.light_samples + 0.05 * w.medium_steps;
}

double bidirectional_cost(const WorkPerSample& w) {
  return 0.15 + 0.30 * w.eye_rays + 0.15 * w.light_samples + 0.30 * w.light_rays +
         0.15 * w.camera_rays + 0.12 * w.connections + 0.10 * w.connection_rays +
         0.15 * w.merge_queries + 0.08 * w.merges + 0.05 * w.stored_vertices +
         0.05 * w.medium_steps;
}

}  // namespace duet
