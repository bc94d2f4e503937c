// How many samples a render is going to have, before it has begun.
#pragma once

#include "integrators/integrator.h"
#include "integrators/method_prediction.h"

namespace duet {

/// Samples per pixel when the first limit of the outlook is reached with a method of such variance
/// and cost; at least 1. The cost counts as microseconds of one thread, so that no clock has a say.
/// The target's error is taken for the root of the mean squared relative error.
int expected_samples(const RenderOutlook& outlook, const PredictedMethod& method);

}  // namespace duet
