// Transforms without what they stretch and shear.
#pragma once

#include <optional>

#include "math/transform.h"

namespace duet {

/// The transform with its y and z axes put at right angles to its x axis and made as long; it still
/// mirrors if it did. So Mitsuba places a unit sphere. Nothing if the axes are like that anyway, up
/// to some digits of a file.
std::optional<Matrix4> unstretched(const Matrix4& to_world);

}  // namespace duet
