// Degrees and radians.
#pragma once

#include <numbers>

namespace duet {

/// Radians per degree.
inline constexpr double kRadians = std::numbers::pi / 180;

}  // namespace duet
