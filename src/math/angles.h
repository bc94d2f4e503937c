// Degrees and radians.
#pragma once

#include <numbers>

namespace duet {

/// Radians per degree.
inline constexpr double kRadians = std::numbers::pi / 180;
/// Degrees of an angle of one radian.
inline constexpr double kDegrees = 180 / std::numbers::pi;

}  // namespace duet
