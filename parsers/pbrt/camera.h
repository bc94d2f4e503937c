// What the readers of cameras share.
#pragma once

#include "pbrt/values.h"

namespace duet::pbrt {

/// Sets what is between the camera's space, with x to the right, and the description's.
void place_camera(SensorDescription& sensor, Reader& reader, const Matrix4& to_camera);

/// A camera of real lenses; the film's description is complete.
void read_realistic(Values& v, SensorDescription& sensor);

}  // namespace duet::pbrt
