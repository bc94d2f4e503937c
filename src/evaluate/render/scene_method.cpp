#include "evaluate/render/scene_method.h"

#include <stdexcept>

#include "base/failures.h"
#include "evaluate/report/scene_render.h"

namespace duet {

SensorDescription& chosen_sensor(SceneDescription& scene, size_t number, const std::string& file) {
  const size_t sensors = scene.sensors.size();
  if (number >= sensors)
    throw UsageError(
        fmt::format("-s {}: {} has {} sensor{}", number, file, sensors, sensors == 1 ? "" : "s"));
  return scene.sensors[number];
}

std::unique_ptr<Integrator> chosen_method(SceneDescription& scene, const SensorDescription& sensor,
                                          const RenderOptions& options, Messages& messages) {
  std::unique_ptr<Integrator> integrator;
  Diagnostics diagnostics;
  try {
    integrator = method_of(scene, sensor, options.integrator, options.techniques, diagnostics);
  } catch (const std::invalid_argument& e) {
    throw UsageError(e.what());
  }
  report(diagnostics, options.read.strict, messages);
  return integrator;
}

}  // namespace duet
