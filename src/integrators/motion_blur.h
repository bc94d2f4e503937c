// How a scene that moves is rendered as the mean over its poses.
//
// Each sample per pixel (or iteration) sees the scene as it is at one time. The times are points of
// a sequence of their own, each of them even over the time that the shutter is open, so the
// expected image is the mean over that time whatever the method, if only the method is right for
// scenes that stand still.
#pragma once

#include "integrators/integrator.h"

namespace duet {

/// When a sample is taken, as a share of the time from the opening of the shutter to its closing.
/// It depends on the seed, the batch and the number of the sample alone.
double time_of_sample(const SampleRange& range, uint32_t sample);

/// Calls `work` for each sample of a range, with a control for this part of the pass, until it is
/// cancelled.
void for_each_sample(const SampleRange& samples, const PassControl& control,
                     const std::function<void(const SampleRange&, const PassControl&)>& work);

}  // namespace duet
