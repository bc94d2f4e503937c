// What groups of pixels would make of the methods among which `auto` chooses.
#pragma once

#include "integrators/group_pilot.h"
#include "integrators/method_choice.h"

namespace duet {

/// Adds `path`, which the first candidate is, and those of `bdpt` in groups of pixels. What groups
/// gain was measured with `path`; with `bdpt` what is found beyond second vertices that are shared
/// is taken to gain as much.
void add_pixel_groups(const PricingRecord& record, const GroupGains& gains, MethodPrices& prices);

bool in_pixel_groups(const MethodCandidate& c);

}  // namespace duet
