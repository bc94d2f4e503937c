// Chooses the method with the least predicted error² · cost, from a pilot that all techniques
// share. Source: Grittmann et al., "Efficiency-Aware Multiple Importance Sampling for Bidirectional
// Rendering Algorithms", SIGGRAPH 2022, for what one method's samples tell of another's variance.
#pragma once

#include <string>
#include <vector>

#include "integrators/integrator.h"
#include "integrators/pricing_pilot.h"
#include "scene/description.h"

namespace duet {

/// A method that may be chosen, by its multiples of the pilot's numbers of samples.
struct MethodCandidate {
  decltype(IntegratorDescription::method) method;
  std::string name;
  double light_paths = 0;    ///< per pixel
  bool connections = false;  ///< with all vertices of a light walk
  double merges = 0;         ///< light paths times merging area, over those of the pilot
};

/// What a candidate would do with the render's samples.
struct PredictedMethod {
  double missing = 0;   ///< share of the light that it cannot find
  double variance = 0;  ///< of one sample per pixel, relative to the square of the image
  double error = 0;     ///< mean squared relative error of the image
  double cost = 0;      ///< of one sample of one pixel
};

PredictedMethod predict(const PricingRecord& record, const MethodCandidate& candidate, int spp);

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
