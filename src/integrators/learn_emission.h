// Learns at which light and with which rays light sub-paths should begin: most rays may meet
// nothing that the image has to do with, such as the outside of a house.
#pragma once

#include <memory>

#include "lights/emission_guide.h"
#include "transport/light_pass.h"

namespace duet {

/// The guide for light sub-paths of the plan's kind, for an image of this size; null where it would
/// help little, and for MediaVertex. The result depends on the scene, the size and the depths
/// of the plan alone.
std::unique_ptr<const EmissionGuide> learn_emission(const Scene& scene, Point2i film,
                                                    const LightPassPlan& plan);

}  // namespace duet
