// What a method would have to do for a sample, from what a pilot had to do.
#pragma once

#include "integrators/method_prediction.h"

namespace duet {

/// What one sample of one pixel costs with a candidate, in the unit of method_costs.h.
double predicted_cost(const PricingRecord& record, const MethodCandidate& candidate);

}  // namespace duet
