// Colours and spectra as text.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "values/color.h"

namespace duet {

/// "#rrggbb" as three numbers from 0 to 1.
std::optional<std::array<double, 3>> parse_hex_color(std::string_view text);

/// Lines of a wavelength and a value; "#" begins a comment. Throws ReadError "file: message".
std::vector<SpectrumSample> parse_spectrum_lines(std::string_view text, const std::string& file);

}  // namespace duet
