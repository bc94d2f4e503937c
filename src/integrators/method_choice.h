// Chooses the method with the least predicted error² · cost, from a pilot that all techniques
// share.
#pragma once

#include <string>
#include <vector>

#include "integrators/integrator.h"
#include "integrators/method_prediction.h"
#include "integrators/method_rules.h"

namespace duet {

struct MethodChoice {
  decltype(IntegratorDescription::method) method;
  std::string reason;                        ///< one line
  std::string bias;                          ///< why the mean of many images is wrong, or ""
  std::vector<std::string> candidates = {};  ///< what each method promised, a line each
};

MethodChoice choose_method(const Scene& scene, const AutoIntegratorDescription& options,
                           const RenderOutlook& outlook);

// In two steps, for benchmarks and tests:

/// The prediction for every candidate that the scene leaves.
struct MethodPrices {
  std::vector<MethodCandidate> candidates;  ///< path tracing, or that through media, first
  std::vector<PredictedMethod> predictions;
  size_t subpaths = 0;  ///< eye sub-paths of the pilot
  int spp = 0;          ///< samples per pixel that the render is expected to have
};
/// A pilot other than the usual one.
struct PilotChoice {
  int pixels_per_side = 0;  ///< 0 for what the render's samples allow
  uint64_t seed = 0;        ///< pilots of different seeds are independent
};
MethodPrices price_methods(const Scene& scene, const AutoIntegratorDescription& options,
                           const RenderOutlook& outlook, const PilotChoice& pilot = {});

/// The method with which least is to be lost, as far as the prices are known.
MethodChoice take(const MethodPrices& prices, const MethodRules& rules);

}  // namespace duet
