#include "evaluate/render/scene_method.h"

#include <stdexcept>

#include "base/failures.h"
#include "evaluate/render/output.h"
#include "evaluate/report/scene_mattes.h"
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

void check_method(const RenderOptions& options, const std::vector<std::string>& images) {
  IntegratorOverride asked = options.integrator;
  IntegratorDescription method;
  try {
    if (asked.name.empty()) asked.parameters.clear();  // the method of the scene may have them
    apply_override(method, {asked.name, {}, {}});
    // The scene may already say what other parameters need.
    if (auto* d = std::get_if<BidirectionalIntegratorDescription>(&method.method)) {
      d->weights = ReuseWeights::thesis_b;
      d->max_depth = 1;
    }
    apply_override(method, asked);
    if (!method.image && asked.layers.empty()) return;  // the scene may have some
    const auto integrator =
        make_integrator(method, asked.name.empty() ? TechniqueOutput::none : options.techniques);
    std::string ignored;
    request_of({}, {options.budget, options.seed, false, options.threads}, *integrator, ignored);
    const SceneMattes mattes(options.mattes, method);
    check_formats(images, mattes.with_channels(integrator->channels()), options.files);
  } catch (const std::invalid_argument& e) {
    throw UsageError(e.what());
  }
}

}  // namespace duet
