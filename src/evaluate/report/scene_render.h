// What a scene says about how it is rendered, and what takes the place of that.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "evaluate/report/header.h"
#include "evaluate/report/image_form.h"
#include "integrators/make_integrator.h"

namespace duet {

/// The method of a scene, or the one that takes its place in the description. What it cannot render
/// goes to `diagnostics`. Throws std::invalid_argument, with a message for the user, for a method
/// or parameters that there are not.
std::unique_ptr<Integrator> method_of(SceneDescription& scene, const SensorDescription& sensor,
                                      const IntegratorOverride& override_with,
                                      TechniqueOutput techniques, Diagnostics& diagnostics);

/// How the samples are chosen.
struct SampleOptions {
  RenderBudget budget;  ///< if it has no limit, the scene's number of samples is one
  std::optional<uint64_t> seed;
  bool strict_sampler = false;  ///< the sampler that the scene names, instead of Sobol' points
  int threads = 1;
};

/// The request of a render without callbacks. `warning` is set if the scene names a sampler that is
/// not available. Throws std::invalid_argument if an error is asked for of an image that has no
/// colours to estimate it from.
RenderRequest request_of(const SamplerDescription& sampler, const SampleOptions& options,
                         const Integrator& integrator, std::string& warning);

/// The facts of a render that follow from its method and its request.
RenderRecord record_of(const IntegratorDescription& description, const Integrator& integrator,
                       const RenderRequest& request);

/// The sensor where it is when its shutter opens: one place stands for all that a moving sensor
/// passes.
SensorDescription opening_view(const SensorDescription& sensor);

/// The form of an image, before the scene is built from its description.
ImageForm form_of(const SensorDescription& sensor, const FilmLayout& layout,
                  const Integrator& integrator);

}  // namespace duet
