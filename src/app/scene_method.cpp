#include "app/scene_method.h"

#include <stdexcept>

#include "app/commands.h"

namespace duet {

SensorDescription& chosen_sensor(SceneDescription& scene, size_t number, const std::string& file) {
  const size_t sensors = scene.sensors.size();
  if (number >= sensors)
    throw UsageError(
        fmt::format("-s {}: {} has {} sensor{}", number, file, sensors, sensors == 1 ? "" : "s"));
  return scene.sensors[number];
}

std::unique_ptr<Integrator> chosen_method(SceneDescription& scene, const SensorDescription& sensor,
                                          const RenderOptions& options, Log& log) {
  std::unique_ptr<Integrator> integrator;
  try {
    apply_override(scene.integrator, options.integrator);
    integrator = make_integrator(scene.integrator, options.techniques);
  } catch (const std::invalid_argument& e) {
    throw UsageError(e.what());
  }
  Diagnostics diagnostics;
  check_support(scene, scene.integrator, diagnostics);
  check_support(sensor, scene.integrator, diagnostics);
  report(diagnostics, options.read.strict, log);
  return integrator;
}

}  // namespace duet
