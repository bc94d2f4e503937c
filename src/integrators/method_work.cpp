#include "integrators/method_work.h"

#include "integrators/method_costs.h"

namespace duet {

namespace {

void add_merges(const PricingRecord& record, const MethodCandidate& c,
                const RenderCounters& counters, WorkPerSample& w) {
  const double subpaths = double(record.subpaths());
  w.merge_queries = double(counters.merge_queries) / subpaths;
  w.merges = c.light_paths * double(counters.merges) / (subpaths * PricingRecord::kMergeShare);
}

}  // namespace

double predicted_cost(const PricingRecord& record, const MethodCandidate& c) {
  const double subpaths = double(record.subpaths());
  WorkPerSample w;
  w.eye_rays = double(record.eye_counters.closest_rays) / subpaths;
  w.light_samples = double(record.eye_counters.shadow_rays) / subpaths;
  w.medium_steps = double(record.eye_counters.medium_steps) / subpaths;
  if (c.light_paths == 0)
    return std::holds_alternative<VolumePathIntegratorDescription>(c.method) ? volpath_cost(w)
                                                                             : path_cost(w);
  w.light_rays = c.light_paths * double(record.light_counters.closest_rays) / subpaths;
  if (c.connections || c.merges > 0)
    w.stored_vertices = c.light_paths * record.light_vertices / subpaths;
  if (c.photons_only) {
    w.eye_rays = double(record.first_counters.closest_rays) / subpaths;
    w.light_samples = 0;
    add_merges(record, c, record.first_counters, w);
    return bidirectional_cost(w);
  }
  w.camera_rays = c.light_paths * double(record.light_counters.shadow_rays) / subpaths;
  w.medium_steps += c.light_paths * double(record.light_counters.medium_steps) / subpaths;
  if (c.connections) {
    const ConnectionCounters& n = record.connection_counters.connections;
    w.connections = double(n.attempted()) / subpaths;
    w.connection_rays = double(record.connection_counters.shadow_rays) / subpaths;
    w.medium_steps += double(record.connection_counters.medium_steps) / subpaths;
  }
  if (c.merges > 0) add_merges(record, c, record.merge_counters, w);
  return record.batches ? batched_cost(w) : bidirectional_cost(w);
}

}  // namespace duet
