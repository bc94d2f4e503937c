// Learns where the environment is seen from what a scene's camera sees.
#pragma once

#include "lights/environment_guide.h"
#include "scene/scene.h"

namespace duet {

/// The guide for light samples of the scene's environment, for an image of this size; nothing where
/// that would help little. The result does not depend on the number of threads.
std::optional<EnvironmentGuide> learn_environment(const Scene& scene, Point2i film, int threads);

}  // namespace duet
