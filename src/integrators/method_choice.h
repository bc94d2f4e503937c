// Chooses the method with the least predicted error² · cost, from a pilot that all techniques
// share.
#pragma once

#include <string>
#include <vector>

#include "integrators/integrator.h"
#include "integrators/method_prediction.h"
#include "scene/description_integrators.h"

namespace duet {

struct MethodChoice {
  decltype(IntegratorDescription::method) method;
  std::string reason;  ///< one line
  std::string bias;    ///< why the mean of many images is wrong, or ""
};

MethodChoice choose_method(const Scene& scene, const AutoIntegratorDescription& options,
                           const RenderOutlook& outlook);

/// The prediction for every candidate that the scene leaves, for benchmarks and tests.
struct MethodPrices {
  std::vector<MethodCandidate> candidates;
  std::vector<PredictedMethod> predictions;
  size_t walks = 0;  ///< eye walks of the pilot
};
MethodPrices price_methods(const Scene& scene, const AutoIntegratorDescription& options,
                           const RenderOutlook& outlook);

}  // namespace duet
