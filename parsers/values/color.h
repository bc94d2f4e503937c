// Colours given as spectra become linear sRGB.
//
// A spectrum given by samples is linear between them and zero outside. It is weighed with the CIE
// 1931 colour matching functions, exactly as long as those are linear between their samples.
// Mitsuba 3, when it renders in RGB, does the same in steps of 0.47 nm, which is the same up to
// rounding unless a spectrum is narrow or has narrow peaks.
#pragma once

#include <span>
#include <vector>

#include "math/spectrum.h"

namespace duet {

/// What a colour stands for; that decides how a spectrum becomes RGB.
enum class ColorMeaning {
  reflectance,  ///< seen under D65, so that a flat spectrum is grey; clamped to [0, 1]
  unbounded,    ///< the same, clamped to be positive: a complex index of refraction, for example
  emission,     ///< as it is: a flat spectrum has the colour of illuminant E
};

/// One entry of a tabulated spectrum; wavelengths in nanometres.
struct SpectrumSample {
  double wavelength, value;
  bool operator==(const SpectrumSample&) const = default;
};

/// The colour of a spectrum; wavelengths must increase.
Spectrum spectrum_to_rgb(std::span<const SpectrumSample> samples, ColorMeaning meaning);

/// The same in the steps of Mitsuba 3.
Spectrum stepped_spectrum_to_rgb(std::span<const SpectrumSample> samples, ColorMeaning meaning);

/// The colour of light with the same power at all wavelengths (illuminant E).
Spectrum equal_energy_rgb(double value);

/// Planck's law: radiance of a black body per nanometre, in W/(m²·sr·nm), at `kelvin`.
std::vector<SpectrumSample> blackbody_spectrum(double kelvin, double scale);

}  // namespace duet
