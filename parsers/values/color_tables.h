// The colour matching functions of the CIE 1931 standard observer and the spectrum of daylight D65.
#pragma once

#include <array>

namespace duet {

inline constexpr int kCieSamples = 95;
/// Wavelengths in nanometres: sample i is at kCieFirst + i · kCieStep, linear in between.
inline constexpr double kCieFirst = 360, kCieLast = 830, kCieStep = 5;

extern const std::array<float, kCieSamples> kCieX, kCieY, kCieZ;
/// Relative power, 100 at 560 nm.
extern const std::array<float, kCieSamples> kD65;

}  // namespace duet
