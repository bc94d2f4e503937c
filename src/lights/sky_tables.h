// The data of Hosek and Wilkie's sky, for linear sRGB.
#pragma once

#include <array>

namespace duet {

/// Turbidities 1 to 10, ground albedos 0 and 1, and control points of a Bézier curve over the cube
/// root of the sun's elevation: what all tables begin with.
inline constexpr int kSkyTurbidities = 10, kSkyControlPoints = 6, kSkyParameters = 9;
/// [turbidity][albedo][control point][channel][parameter]
extern const std::array<float, 10 * 2 * 6 * 3 * 9> kSkyShape;
/// [turbidity][albedo][control point][channel]
extern const std::array<float, 10 * 2 * 6 * 3> kSkyRadiance;
/// Irradiance of the sun on a plane across: [turbidity][elevation 2°, 5°, … 89°][channel].
inline constexpr int kSunElevations = 30;
extern const std::array<float, 10 * 30 * 3> kSunIrradiance;

}  // namespace duet
