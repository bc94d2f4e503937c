// How bright the sun of Mitsuba 0.x is.
#pragma once

#include <array>

#include "math/spectrum.h"
#include "scene/description.h"

namespace duet {

/// Across, in degrees: the disk whose radiance the model gives.
inline constexpr double kSunAperture0x = 0.5358;

/// Irradiance of the sun on a plane across its direction, below the atmosphere: the radiance of its
/// disk times the disk's solid angle, in W/(m²·nm) as linear sRGB, where a flat spectrum of one has
/// luminance one. Any turbidity; `zenith` is the angle of the sun from the zenith in radians, from
/// 0 to π/2.
/// Source: Preetham, Shirley & Smits, "A Practical Analytic Model for Daylight", SIGGRAPH 1999,
/// appendix 1, with water vapour of 2 cm and 0.35 cm of ozone.
Spectrum sun_irradiance_0x(double turbidity, double zenith);

/// The disk of the sun in the direction `sun`, which is drawn away from the zenith like the sky is
/// (z is up); its brightness is that of the true place.
SunDisk sun_disk_0x(const std::array<double, 3>& sun, double turbidity, double stretch);

/// The place of the sky's model, whose +z is up, in the world of 0.x, where +y is.
Matrix4 y_up_sky();

/// A sun without a size, seen from the world; the sky's transform is that of `sky`.
LightDescription directional_sun(const SunDisk& disk, double scale, const LightDescription& sky);

}  // namespace duet
