// Methods that trace sub-paths from the camera and from the lights.
#pragma once

#include <memory>

#include "integrators/camera_integrator.h"
#include "scene/description.h"

namespace duet {

/// The method that `description` names, with the layers that `output` asks for.
std::unique_ptr<Integrator> make_bidirectional(
    const BidirectionalIntegratorDescription& description, const CameraOutput& output);

}  // namespace duet
