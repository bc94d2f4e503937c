// Images that go to standard output.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace duet {

/// What stands for a path, before the extension of the format: "<stdout>.png".
inline const std::string kStandardOutput = "<stdout>";

bool is_standard_output(const std::string& path);

/// Empty, or why no image can be written there: a terminal shows no images.
std::string standard_output_refusal();

/// Throws std::runtime_error with the reason if not all bytes can be written.
void write_standard_output(std::span<const uint8_t> bytes);

}  // namespace duet
