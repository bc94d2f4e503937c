#include "integrators/method_candidates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace duet {

namespace {

/// Mean over the iterations of the first merging area over theirs: the radius shrinks.
double mean_shrinkage(double alpha, int iterations) {
  double sum = 0;
  int counted = 0;
  for (int i = 1; i <= iterations; i += 1 + i / 16, ++counted) sum += std::pow(i, 1 - alpha);
  return sum / std::max(1, counted);
}

BidirectionalIntegratorDescription bidirectional(const PathLimits& o, BidirectionalMethod method,
                                                 double light_paths, int connections) {
  BidirectionalIntegratorDescription d;
  d.method = method;
  d.max_depth = o.max_depth;
  d.rr_depth = o.rr_depth;
  d.hide_emitters = o.hide_emitters;
  d.strict_normals = o.strict_normals;
  d.light_selection = o.light_selection;
  d.light_paths = light_paths;
  d.connections = connections;
  return d;
}

SceneLimits limits_of(const Scene& scene) {
  return {.media = !scene.media.empty(),
          .one_way_surfaces = scene.features.one_way_surfaces > 0,
          .connectible = scene.camera->connectible(),
          .emissive_media = scene.features.emissive_media > 0,
          .skips_masks = scene.features.skips_masks};
}

}  // namespace

MethodCandidate camera_candidate(const MethodRules& rules, const PathLimits& o) {
  if (rules.skips_passed_surfaces) return {VolumePathIntegratorDescription{o}, "volpath"};
  return {PathIntegratorDescription{o}, "path"};
}

Obstacle obstacle_to_light_subpaths(const Scene& scene, const PathLimits& limits) {
  return find_obstacle(limits_of(scene), bidirectional(limits, BidirectionalMethod::bdpt, 1, -1));
}

std::vector<MethodCandidate> method_candidates(const Scene& scene, const PathLimits& o,
                                               int iterations) {
  using enum BidirectionalMethod;
  const MethodRules rules = method_rules(scene.features);
  std::vector<MethodCandidate> list{camera_candidate(rules, o)};
  const auto add = [&](BidirectionalMethod method, double light, int connections, double merges) {
    list.push_back({bidirectional(o, method, light, connections),
                    fmt::format("{} light_paths={:g}{}", method == vcm ? "vcm" : "bdpt", light,
                                connections == 0 ? " connections=0" : ""),
                    light, connections != 0, merges});
  };
  for (const double light : {1 / 16.0, 1 / 4.0, 1.0})
    for (const int connections : {-1, 0}) add(bdpt, light, connections, 0);
  if (!rules.may_merge) return list;
  for (const double light : {1 / 4.0, 1.0})
    for (const int connections : {-1, 0})
      add(vcm, light, connections, light / mean_shrinkage(0.75, iterations));
  list.push_back({.method = bidirectional(o, ppm, 1, -1),
                  .name = "ppm light_paths=1",
                  .light_paths = 1,
                  .merges = 1 / mean_shrinkage(2.0 / 3, iterations),
                  .photons_only = true});
  std::erase_if(list, [&](const MethodCandidate& c) {
    return find_obstacle(limits_of(scene), c.method) != Obstacle::none;
  });
  return list;
}

}  // namespace duet
