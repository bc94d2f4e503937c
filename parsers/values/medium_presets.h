// Scattering coefficients of real materials by name.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "math/spectrum.h"

namespace duet {

/// Scattering and absorption per millimetre, as linear sRGB, and the mean cosine of scattering.
struct MediumPreset {
  const char* name;
  Spectrum sigma_s, sigma_a, g;
};

/// Found in any case; null if there is no such name. The names are those of Mitsuba 0.6.
const MediumPreset* find_medium_preset(std::string_view name);
std::vector<std::string> medium_preset_names();
/// That there is no such name, and which one may be meant.
std::string no_medium_preset(const std::string& name);

}  // namespace duet
