// The methods among which `auto` chooses.
#pragma once

#include <vector>

#include "integrators/method_prediction.h"
#include "integrators/method_rules.h"

namespace duet {

/// The method whose sub-paths all start at the camera.
MethodCandidate camera_candidate(const MethodRules& rules, const PathLimits& limits);

/// Why methods that trace sub-paths from the lights cannot render the scene, if so.
Obstacle obstacle_to_light_subpaths(const Scene& scene, const PathLimits& limits);

/// All methods that the scene leaves, the one above first. The radius of those that merge shrinks
/// over so many iterations.
std::vector<MethodCandidate> method_candidates(const Scene& scene, const PathLimits& limits,
                                               int iterations);

}  // namespace duet
