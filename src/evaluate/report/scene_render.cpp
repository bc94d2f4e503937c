#include "evaluate/report/scene_render.h"

#include <fmt/format.h>

#include <stdexcept>

namespace duet {

std::unique_ptr<Integrator> method_of(SceneDescription& scene, const SensorDescription& sensor,
                                      const IntegratorOverride& override_with,
                                      TechniqueOutput techniques, Diagnostics& diagnostics) {
  apply_override(scene.integrator, override_with);
  std::unique_ptr<Integrator> integrator = make_integrator(scene.integrator, techniques);
  check_support(scene, scene.integrator, diagnostics);
  check_support(sensor, scene.integrator, diagnostics);
  return integrator;
}

RenderRequest request_of(const SamplerDescription& sampler, const SampleOptions& options,
                         const Integrator& integrator, std::string& warning) {
  RenderRequest request;
  request.budget = options.budget;
  if (!request.budget.spp && !request.budget.seconds && !request.budget.target_error)
    request.budget.spp = sampler.sample_count;
  if (request.budget.target_error && integrator.channels()[0] != "R")
    throw std::invalid_argument(
        "--target-error: the image has layers only, no colours to estimate it from");
  request.seed = options.seed.value_or(sampler.seed);
  request.threads = options.threads;
  request.sequence = SampleSequence::sobol;
  if (options.strict_sampler && sampler.name == "independent")
    request.sequence = SampleSequence::independent;
  else if (options.strict_sampler && sampler.name != "sobol")
    warning = fmt::format(
        "the sampler \"{}\" is not available; Owen-scrambled Sobol' points are used", sampler.name);
  return request;
}

RenderRecord record_of(const IntegratorDescription& description, const Integrator& integrator,
                       const RenderRequest& request) {
  RenderRecord record;
  record.bias = integrator.bias();
  record.integrator = integrator_name(description);
  record.integrator_parameters = integrator_parameters(description);
  record.sampler = request.sequence == SampleSequence::sobol ? "sobol" : "independent";
  record.seed = request.seed;
  record.threads = request.threads;
  record.requested = request.budget;
  return record;
}

SensorDescription opening_view(const SensorDescription& sensor) {
  SensorDescription view = sensor;
  if (!sensor.motion.empty()) view.to_world = sensor.motion.at(sensor.shutter[0]) * sensor.to_world;
  return view;
}

ImageForm form_of(const SensorDescription& sensor, const FilmLayout& layout,
                  const Integrator& integrator) {
  return {layout.crop,
          layout.full,
          sensor.film.pixel_format,
          sensor.film.component_format == ComponentFormat::half,
          integrator.data_channels(),
          sensor.film.tone_mapping};
}

}  // namespace duet
