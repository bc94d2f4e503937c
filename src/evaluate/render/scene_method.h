// The sensor and the method that the command line chooses for a scene.
#pragma once

#include <memory>
#include <string>

#include "base/messages.h"
#include "evaluate/render/render_options.h"

namespace duet {

/// The sensor of -s. Throws UsageError if the scene of this file does not have it.
SensorDescription& chosen_sensor(SceneDescription& scene, size_t number, const std::string& file);

/// Makes the method, which takes the place of the scene's, and reports what it cannot render.
/// Throws UsageError for a method or parameters that there are not, and SceneFailure after errors.
std::unique_ptr<Integrator> chosen_method(SceneDescription& scene, const SensorDescription& sensor,
                                          const RenderOptions& options, Messages& messages);

/// Throws UsageError for what no scene can be rendered with, as far as that is known before one is
/// read: a method, parameters of a method that is named, layers, and names of images whose formats
/// cannot hold these.
void check_method(const RenderOptions& options, const std::vector<std::string>& images);

}  // namespace duet
