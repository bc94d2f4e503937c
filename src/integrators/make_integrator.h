// From the description of a method to the method.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "integrators/camera_integrator.h"
#include "scene/description_integrators.h"

namespace duet {

struct SceneDescription;
struct SensorDescription;

/// Names for IntegratorOverride::name, with one line each about what the method does.
struct IntegratorName {
  std::string name, summary;
};
const std::vector<IntegratorName>& integrator_names();

/// What the command line asks for instead of what the scene says.
struct IntegratorOverride {
  std::string name;  ///< "" keeps the scene's method
  std::vector<std::pair<std::string, std::string>> parameters;
  std::vector<std::string> layers;
};

/// Applies an override. Throws std::invalid_argument, with a message for the user, for names,
/// parameters and values that do not exist.
void apply_override(IntegratorDescription& integrator, const IntegratorOverride& override_with);

/// The method's name and its parameters as "max_depth=8 rr_depth=2 …".
std::string integrator_name(const IntegratorDescription& integrator);
std::string integrator_parameters(const IntegratorDescription& integrator);

/// What the layers of the description ask of surfaces.
SurfaceNeeds integrator_needs(const IntegratorDescription& integrator);

/// Reports what the scene has and its method cannot render.
void check_support(const SceneDescription& scene, const IntegratorDescription& integrator,
                   Diagnostics& diagnostics);

/// Reports if the method needs what the sensor does not have: that light sub-paths can be connected
/// with it.
void check_support(const SensorDescription& sensor, const IntegratorDescription& integrator,
                   Diagnostics& diagnostics);

/// Throws std::invalid_argument if a layer does not exist, or if there are no techniques to show.
std::unique_ptr<Integrator> make_integrator(const IntegratorDescription& integrator,
                                            TechniqueOutput techniques = TechniqueOutput::none);

}  // namespace duet
