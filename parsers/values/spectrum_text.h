// Colours and spectra as text.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "values/color.h"

namespace duet {

/// "#rrggbb" as three numbers from 0 to 1.
std::optional<std::array<double, 3>> parse_hex_color(std::string_view text);

/// The place of the first wavelength that is not greater than the one before it; 0 if all are.
size_t first_not_increasing(std::span<const SpectrumSample> samples);

/// Lines of a wavelength and a value; "#" begins a comment. Throws ReadError "file: message".
std::vector<SpectrumSample> parse_spectrum_lines(std::string_view text, const std::string& file);

}  // namespace duet
